"""requirements.in, requirements.lock and docs/dependencies.md agree."""

import re

from tools.setup.layout import LOCK, REQUIREMENTS, ROOT


def pins(text: str) -> set[str]:
    return set(re.findall(r"^[a-z0-9-]+==\S+", text, re.MULTILINE))


def test_every_direct_dependency_is_pinned_and_locked() -> None:
    lines = [line for line in REQUIREMENTS.read_text().splitlines() if line and not line.startswith("#")]
    assert set(lines) == pins("\n".join(lines))
    assert set(lines) <= pins(LOCK.read_text())


def test_every_direct_dependency_is_explained() -> None:
    named = {pin.split("==")[0] for pin in pins(REQUIREMENTS.read_text())}
    table = (ROOT / "docs" / "dependencies.md").read_text()
    assert set(re.findall(r"^\| `([a-z0-9-]+)`", table, re.MULTILINE)) == named

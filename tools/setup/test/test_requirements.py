"""requirements.in, requirements.lock and docs/dependencies.md agree."""

import re
from pathlib import Path

import pytest

from tools.setup.layout import LOCK, OLD_LOCK, REQUIREMENTS, ROOT

each_lock = pytest.mark.parametrize("lock", [LOCK, OLD_LOCK], ids=["new", "old"])


def pins(text: str) -> set[str]:
    return set(re.findall(r"^[a-z0-9-]+==\S+", text, re.MULTILINE))


def test_every_direct_dependency_is_pinned_and_locked() -> None:
    lines = [line for line in REQUIREMENTS.read_text().splitlines() if line and not line.startswith("#")]
    assert set(lines) == pins("\n".join(lines))
    assert set(lines) <= pins(LOCK.read_text())


@each_lock
def test_every_locked_package_has_hashes(lock: Path) -> None:
    entries = re.split(r"^(?=[a-z0-9-]+==)", lock.read_text(), flags=re.MULTILINE)[1:]
    assert len(entries) == len(pins(lock.read_text())) > 0
    assert not [entry.split()[0] for entry in entries if "--hash=sha256:" not in entry]


@each_lock
def test_the_lock_names_no_place(lock: Path) -> None:
    assert not re.search(r"://|--(find-links|index-url|extra-index-url)|\s/", lock.read_text())


def test_every_direct_dependency_is_explained() -> None:
    named = {pin.split("==")[0] for pin in pins(REQUIREMENTS.read_text())}
    table = (ROOT / "docs" / "dependencies.md").read_text()
    assert set(re.findall(r"^\| `([a-z0-9-]+)`", table, re.MULTILINE)) == named

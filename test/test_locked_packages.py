"""What comes from the package index is pinned and checked by hash: the environment, and what single tools add."""

import re
from pathlib import Path

import pytest

from tools.setup.layout import LOCK, OLD_LOCK, ROOT, tool_pins

OF_TOOLS = sorted(ROOT.glob("tools/**/requirements.txt"))
LOCKED = [LOCK, OLD_LOCK, *OF_TOOLS]

each_locked = pytest.mark.parametrize("locked", LOCKED, ids=lambda path: str(path.relative_to(ROOT)))


def entries(locked: Path) -> list[list[str]]:
    """The lines of each package: its pin first, then its hashes."""
    lines = (line.strip().removesuffix(" \\") for line in locked.read_text(encoding="utf-8").splitlines())
    found: list[list[str]] = []
    for line in (line for line in lines if line and not line.startswith("#")):
        if not line.startswith("--hash="):
            found.append([])
        found[-1].append(line)
    return found


@each_locked
def test_every_package_has_one_version_and_the_hashes_of_its_files(locked: Path) -> None:
    assert entries(locked)
    for pin, *hashes in entries(locked):
        assert re.fullmatch(r"[\w.-]+==[\w.+!-]+( ;.*)?", pin)
        assert hashes
        assert all(re.fullmatch(r"--hash=sha256:[0-9a-f]{64}", one) for one in hashes)


@each_locked
def test_no_index_is_named(locked: Path) -> None:
    assert "://" not in locked.read_text(encoding="utf-8")


def test_what_single_tools_add_is_what_they_ask_for() -> None:
    assert {pins.with_suffix(".txt") for pins in tool_pins()} == {*OF_TOOLS}
    for pins in tool_pins():
        wanted = [line for line in pins.read_text(encoding="utf-8").splitlines() if line and line[0] != "#"]
        assert [pin for pin, *_ in entries(pins.with_suffix(".txt"))] == wanted


def test_pip_is_asked_to_check_the_hashes() -> None:
    recipes = (ROOT / "Makefile").read_text(encoding="utf-8")
    asked = re.findall(r"(\S+) -r (tools/[\w/]+/requirements\.txt)", recipes)
    assert sorted(ROOT / file for _, file in asked) == OF_TOOLS
    assert {option for option, _ in asked} == {"--require-hashes"}

"""docs/errata.md names for every entry a test that is there, and every test of an equation is named by it."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TESTS = ROOT / "continuum" / "test"


def names_of_tests(path: Path) -> set[str]:
    return set(re.findall(r"^def (test_\w+)", path.read_text(encoding="utf-8"), re.MULTILINE))


def test_every_check_that_the_page_names_is_there_and_no_other() -> None:
    named = set(re.findall(r"`(test_\w+)`", (ROOT / "docs" / "errata.md").read_text(encoding="utf-8")))
    there = names_of_tests(TESTS / "test_errata.py") | names_of_tests(TESTS / "test_errata_dynamics.py")
    assert there <= named
    assert named <= there | names_of_tests(TESTS / "test_chain.py")

"""A fault is found, survives, or is no entry; whatever it is, the checkout stays as it was."""

from pathlib import Path

import pytest

from tools.benchmarks.seeded_faults.__main__ import ROOT, TABLE, main
from tools.benchmarks.seeded_faults.table import read_faults

pytestmark = pytest.mark.slow

FILES = {
    "halved.py": "def halved(x):\n    return x / 2\n\n\ndef unused(x):\n    return x + 1\n",
    "test_halved.py": "from halved import halved\n\n\ndef test_two():\n    assert halved(4) == 2\n",
    "test_red.py": "def test_red():\n    assert False\n",
    "pytest.ini": "[pytest]\npythonpath = .\n",
}


def tried(folder: Path, fault: str, test: str = "test_halved.py") -> int:
    """Exit code of the command with one fault in a checkout of these files."""
    root = folder / "checkout"
    root.mkdir()
    for name, text in FILES.items():
        (root / name).write_text(text, encoding="utf-8")
    table = folder / "faults.toml"
    table.write_text(f'[[file]]\npath = "halved.py"\ntests = ["{test}"]\nfaults = [{fault}]\n', encoding="utf-8")
    code = main([], root, table)
    assert all((root / name).read_text(encoding="utf-8") == text for name, text in FILES.items())
    return code


@pytest.mark.parametrize(
    ("fault", "outcome", "code"),
    [
        ('["x / 2", "x / 3"]', "killed ", 0),
        ('["x + 1", "x - 1"]', "survived ", 1),
        ('["return x", "return y"]', "broken entry ", 1),
    ],
)
def test_a_fault_becomes_what_the_tests_make_of_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], fault: str, outcome: str, code: int
) -> None:
    assert tried(tmp_path, fault) == code
    assert capsys.readouterr().out.startswith(outcome)


def test_a_test_that_fails_anyway_finds_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert tried(tmp_path, '["x / 2", "x / 3"]', "test_red.py") == 1
    assert "test_red.py::test_red fails without a fault too" in capsys.readouterr().err


def test_every_entry_of_the_list_fits_the_code() -> None:
    assert [str(fault) for fault in read_faults(TABLE) if fault.problem(ROOT)] == []

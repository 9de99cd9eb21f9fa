"""The command `continuum` called from tests, and what it printed."""

import os
from pathlib import Path
from unittest.mock import patch

import pytest

from continuum.cli import main

CONFIG = Path(__file__).parents[2] / "continuum_description" / "config"
THREE = str(CONFIG / "three_sections.yaml")

Captured = pytest.CaptureFixture[str]


def code(*words: object) -> int:
    """The exit code, whether returned or raised by the parser, on a screen of 80 columns."""
    try:
        with patch.dict(os.environ, COLUMNS="80"):
            return main([str(word) for word in words])
    except SystemExit as end:
        return int(end.code or 0)


def rows_of(output: str, arm_names: list[str]) -> list[list[str]]:
    """The words of the lines that begin with a section's name."""
    return [line.split() for line in output.splitlines() if line.split(" ")[0] in arm_names]


def refused(capsys: Captured, *words: object) -> str:
    """The one line by which a command is refused, with exit code 2 and nothing on stdout."""
    assert code(*words) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    assert captured.err.startswith("continuum: ")
    return captured.err.removeprefix("continuum: ")

"""`continuum view`: what it refuses before it serves a page, and what it says while one waits."""

import sys
from pathlib import Path

import pytest
from command_line import THREE, Captured, code, refused


def test_an_arm_next_to_an_arm_is_refused(capsys: Captured) -> None:
    assert "--arm" in refused(capsys, "view", THREE, "--arm", THREE)


def test_a_name_of_no_file_is_that_of_an_arm(capsys: Captured, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    line = refused(capsys, "view", "three_sectons")
    assert line.endswith("; did you mean three_sections?\n")
    assert "three_sections.yaml" in line


def test_a_recording_is_named_while_one_waits_for_it(
    capsys: Captured, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    assert code("view", str(tmp_path)) == 2  # no recording
    assert capsys.readouterr().out == f"reading {tmp_path} ...\n"


def test_a_refused_recording_is_one_line_in_a_pipe(capsys: Captured, tmp_path: Path) -> None:
    assert str(tmp_path) in refused(capsys, "view", str(tmp_path))

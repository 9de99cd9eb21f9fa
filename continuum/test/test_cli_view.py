"""`continuum view`: what it refuses before it serves a page, and what it says while one waits."""

import sys
import webbrowser
from pathlib import Path

import pytest
from command_line import THREE, Captured, code, refused
from hypothesis import given
from hypothesis import strategies as st

from continuum.cli.browser_window import open_window
from continuum.cli.viewed_files import labels


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


def test_a_model_is_drawn_over_one_recording(capsys: Captured) -> None:
    assert "only beside a recording" in refused(capsys, "view", THREE, "--model", "lamecc_prototype.yaml")
    two = ("view", "a.csv", "b.csv", "--model", "lamecc_prototype.yaml")
    assert "only beside one recording" in refused(capsys, *two)


@given(st.lists(st.sampled_from(["a.csv", "x/a.csv", "y/a.csv", "b.csv"]), max_size=6))
def test_files_have_different_labels(paths: list[str]) -> None:
    assert len(set(labels(paths))) == len(paths)


@pytest.mark.parametrize("terminal", [True, False])
@pytest.mark.parametrize("screen", [True, False])
def test_a_browser_opens_only_for_a_user_with_a_screen(
    monkeypatch: pytest.MonkeyPatch, terminal: bool, screen: bool
) -> None:
    opened: list[str] = []
    monkeypatch.setattr(sys.stdout, "isatty", lambda: terminal)
    monkeypatch.setattr(sys, "platform", "linux")
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    if screen:
        monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(webbrowser, "open", opened.append)
    open_window("http://127.0.0.1:8080")
    assert bool(opened) is (terminal and screen)


def test_a_refused_recording_is_one_line_in_a_pipe(capsys: Captured, tmp_path: Path) -> None:
    assert str(tmp_path) in refused(capsys, "view", str(tmp_path))

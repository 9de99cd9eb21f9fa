"""`continuum view`: what it refuses before it serves a page, and what it says while one waits."""

import sys
import threading
import time
import webbrowser
from pathlib import Path
from queue import SimpleQueue

import numpy as np
import pytest
import recorded_runs
import swing_bag
from command_line import THREE, Captured, code, refused
from hypothesis import given
from hypothesis import strategies as st

from continuum.arm import Arm
from continuum.cli.browser_window import open_window
from continuum.cli.viewed_files import labels
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.parameters import Parameters
from continuum.errors import InvalidValueError
from continuum.recordings.read_recording import read_recording
from continuum.viewer.model_arm import is_approximate, planar_section
from continuum.viewer.seen import Source


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


def page_of(monkeypatch: pytest.MonkeyPatch, *words: object) -> tuple[Arm, Source]:
    """The arm and the source of the page that the command would serve."""
    made: list[tuple[Arm, Source]] = []

    def refused_page(arm: Arm, source: Source, *_: object, **__: object) -> None:
        made.append((arm, source))
        raise InvalidValueError("page", "made", "none in this test")

    monkeypatch.setattr("continuum.viewer.page.Page", refused_page)
    assert code("view", *words) == 2
    ((arm, source),) = made
    return arm, source


def table(path: Path, n_joints: int = 5) -> Path:
    """A recording of swaying joints."""
    rows = np.zeros((60, 1 + n_joints))
    rows[:, 0] = np.arange(60) / 100
    rows[:, 1:] = 5.0 * np.cos(20.0 * rows[:, :1])
    header = ",".join(["t_s", *(f"q{i}_deg" for i in range(1, n_joints + 1))])
    np.savetxt(path, rows, delimiter=",", header=header, comments="", fmt="%.6f")
    return path


ARM_FILE = """
arm:
  sections: [elbow, wrist]
  elbow: {n_joints: 2, half_spacing: 0.02, hole_radius: 0.03, bend_limit: 1.5}
  wrist:
    n_joints: 5
    half_spacing_mm: 15
    hole_radius_mm: 20
    cable_azimuths_deg: [90, 270, 0, 180]
    mass: 0.03
    inertia: 5.0e-6
    dynamics: {center_of_mass: 0.015, stiffness: 0.2}
"""


@pytest.mark.slow
def test_the_arm_of_a_model_is_drawn(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(ARM_FILE, encoding="utf-8")
    model = load_model(tmp_path / "arm.yaml", "wrist")
    save_model(model, tmp_path / "model.yaml")
    run = table(tmp_path / "run.csv")
    of_section = ("--model", tmp_path / "arm.yaml", "--section", "wrist")
    for words in (of_section, ("--model", tmp_path / "model.yaml")):
        arm, _ = page_of(monkeypatch, run, *words)
        assert arm.length == pytest.approx(0.15)
        (section,) = arm.sections
        assert (section.name, section.a) == ("section_1", pytest.approx(0.02))
        first, second = section.cable_azimuths[:2]
        assert second - first == pytest.approx(np.pi)  # as the model pulls them
    two = {"half_spacing": np.array([0.01, 0.02, 0.01, 0.02, 0.01])}
    spacing = model.with_values(two).parameters
    assert planar_section("s", spacing).length == pytest.approx(float(np.sum(spacing.joint_spacing)))
    assert is_approximate(spacing)
    assert not is_approximate(model.parameters)
    arm, _ = page_of(monkeypatch, run, "--arm", "prototype", *of_section)
    assert arm.length == pytest.approx(0.1925)


@pytest.mark.slow
def test_notes_on_the_simulated_recording_are_printed(
    monkeypatch: pytest.MonkeyPatch, capsys: Captured, tmp_path: Path
) -> None:
    topics = swing_bag.swing()
    for one in topics["/cable_states"]:
        one.effort = np.empty(0)
    folder = recorded_runs.write(tmp_path / "run", topics)
    three = load_model("lamecc_prototype.yaml").parameters.named()
    save_model(Model(Parameters(**{name: value[:3] for name, value in three.items()})), tmp_path / "three.yaml")
    page_of(monkeypatch, folder, "--model", tmp_path / "three.yaml")
    notes = read_recording(folder).notes
    assert notes
    lines = capsys.readouterr().err.splitlines()
    assert [sum(str(note) in line for line in lines) for note in notes] == [1] * len(notes)


def test_an_arm_next_to_a_recording_is_refused_with_the_option_for_it(capsys: Captured, tmp_path: Path) -> None:
    run = table(tmp_path / "run.csv")
    for words in ((THREE, run), (run, THREE), ("three_sections", run)):
        line = refused(capsys, "view", *words)
        assert "--arm" in line
        assert "--model" in line


def test_a_mistyped_recording_is_no_arm_alone(
    capsys: Captured, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    for words in (("run_30",), ("run_30", "--model", "lamecc_prototype")):
        assert "no recording" in refused(capsys, "view", *words)


def test_recordings_of_two_arms_are_refused_by_their_names(capsys: Captured, tmp_path: Path) -> None:
    first, second = table(tmp_path / "five.csv", 5), table(tmp_path / "four.csv", 4)
    line = refused(capsys, "view", first, second)
    assert str(first) in line
    assert line.startswith(str(second))
    assert "arm file" not in line


@given(st.lists(st.sampled_from(["a.csv", "x/a.csv", "y/a.csv", "b.csv"]), max_size=6))
def test_files_have_different_labels(paths: list[str]) -> None:
    assert len(set(labels(paths))) == len(paths)


@pytest.mark.parametrize("terminal", [True, False])
@pytest.mark.parametrize("screen", [True, False])
def test_a_browser_opens_only_for_a_user_with_a_screen(
    monkeypatch: pytest.MonkeyPatch, terminal: bool, screen: bool
) -> None:
    opened: SimpleQueue[str] = SimpleQueue()
    closed = threading.Event()
    monkeypatch.setattr(sys.stdout, "isatty", lambda: terminal)
    monkeypatch.setattr(sys, "platform", "linux")
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    if screen:
        monkeypatch.setenv("DISPLAY", ":0")

    def wait_for_end(address: str) -> None:
        """As a browser in the terminal does."""
        opened.put(address)
        closed.wait(30.0)

    monkeypatch.setattr(webbrowser, "open", wait_for_end)
    begin = time.monotonic()
    open_window("http://127.0.0.1:8080")
    assert time.monotonic() - begin < 20.0
    if terminal and screen:
        assert opened.get(timeout=30.0) == "http://127.0.0.1:8080"
    closed.set()
    assert opened.empty()


def test_a_refused_recording_is_one_line_in_a_pipe(capsys: Captured, tmp_path: Path) -> None:
    assert str(tmp_path) in refused(capsys, "view", str(tmp_path))

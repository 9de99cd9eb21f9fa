"""`continuum simulate` of an arm file with several sections."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from command_line import Captured, code, refused

from continuum.arm import load_arm
from continuum.kinematics.routing import tangle

THREE = "three_sections"


def table(path: Path, letter: str, unit: str, rows: list[list[float]]) -> Path:
    heading = ["t_s", *(f"{letter}{cable + 1}_{unit}" for cable in range(len(rows[0]) - 1))]
    with path.open("w", newline="") as file:
        csv.writer(file).writerows([heading, *rows])
    return path


def test_a_release_swings_about_the_hanging_arm_and_is_written(capsys: Captured, tmp_path: Path) -> None:
    out, picture = tmp_path / "motion.csv", tmp_path / "motion.png"
    words = [THREE, "--release", "30@0,40@90,30@180", "--duration", "1", "--json", "--csv", out, "--picture", picture]
    assert code("simulate", *words) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["status"], found["degrees_of_freedom"], found["cables"]) == ("COMPLETE", 30, 12)
    assert found["error"] > 0.0
    with out.open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == found["samples"] == 121
    first, last = ([float(row[f"tip_{axis}_m"]) for axis in "xyz"] for row in (rows[0], rows[-1]))
    np.testing.assert_allclose([first, last], [found["tip_first"], found["tip_last"]], atol=1e-8)
    bend = sum(float(rows[0][f"section_2_u_{joint}_deg"]) for joint in range(1, 6))
    assert bend == pytest.approx(-40.0, abs=1e-6)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_motors_that_hold_lengths_bend_the_arm_to_them(capsys: Captured, tmp_path: Path) -> None:
    arm = load_arm("three_sections.yaml")
    straight, bent = (tangle(np.radians(w), arm) for w in (np.zeros((3, 2)), [[0.0, 20.0], [15.0, 0.0], [0.0, -20.0]]))
    lengths = table(tmp_path / "l.csv", "l", "m", [[0.0, *straight], [1.0, *bent], [1.5, *bent]])
    assert code("simulate", THREE, "--lengths", lengths, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    pulled = np.array(found["lengths"])
    assert np.all(pulled < bent + 2e-3)  # elastic, and slack where the others pull
    for w, wanted in zip(found["bends"], [[0.0, 20.0], [15.0, 0.0], [0.0, -20.0]], strict=True):
        np.testing.assert_allclose(np.degrees(w), wanted, atol=4.0)


def test_wrong_words_are_one_line_each(capsys: Captured, tmp_path: Path) -> None:
    two = table(tmp_path / "u.csv", "u", "N", [[0.0, 1.0, 1.0], [1.0, 1.0, 1.0]])
    assert "u12_N" in refused(capsys, "simulate", THREE, "--tensions", two)
    for option, value in (("--release", "1,2"), ("--release", "30@x"), ("--integrator", "bdf"), ("--step", "0")):
        assert option.removeprefix("--") in refused(capsys, "simulate", THREE, option, value)
    assert "--step" in refused(capsys, "simulate", THREE, "--step", "1e-22")
    assert "meet" in refused(capsys, "simulate", THREE, "--release", "400@0")
    assert "--model" in refused(capsys, "simulate", THREE, "--model", "double_pendulum")
    in_mm = table(tmp_path / "mm.csv", "l", "m", [[0.0, *[192.5] * 12]])
    assert "l1_m" in refused(capsys, "simulate", THREE, "--lengths", in_mm)
    assert "--step" in refused(capsys, "simulate", "--step", "1e-3")
    assert "--pulled" in refused(capsys, "simulate", THREE, "--pulled", "--release", "30")
    assert "--lengths" in refused(capsys, "simulate", "--lengths", two)

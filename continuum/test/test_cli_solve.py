"""`continuum solve`: targets from the command line or a file, answers as a table or as JSON."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from command_line import THREE, Captured, code, refused, rows_of
from scipy.spatial.transform import Rotation

from continuum.arm import load_arm
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import allen_from_jones
from continuum.kinematics.routing import tangle


def test_solve_tells_a_posture_that_reaches_the_point(capsys: Captured) -> None:
    target = [0.15, 0.05, 0.20]
    assert code("solve", THREE, *target) == 0
    output = capsys.readouterr().out
    arm = load_arm(THREE)
    assert output.startswith("reached; the tip is ")
    assert max(map(len, output.splitlines())) <= 80
    figures = np.array([row[1:] for row in rows_of(output, [s.name for s in arm.sections])], dtype=float)
    w = allen_from_jones(np.radians(figures[:, 1]), np.radians(figures[:, 0]))
    np.testing.assert_allclose(arm_pose(w, arm)[:3, 3], target, atol=2e-4)
    np.testing.assert_allclose(figures[:, 2:].ravel(), 1e3 * tangle(w, arm), atol=0.05)
    assert all(unit in output for unit in ("[deg]", "[mm]"))


def test_solve_turns_the_tip(capsys: Captured) -> None:
    assert code("solve", THREE, 0.1, 0.0, 0.4, "--direction", 1, 0, 1) == 0
    output = capsys.readouterr().out
    assert "degrees off its direction" in output
    arm = load_arm(THREE)
    figures = np.array([row[1:3] for row in rows_of(output, [s.name for s in arm.sections])], dtype=float)
    tip = arm_pose(allen_from_jones(np.radians(figures[:, 1]), np.radians(figures[:, 0])), arm)
    np.testing.assert_allclose(tip[:3, 2], np.array([1, 0, 1]) / np.sqrt(2), atol=2e-3)


def test_negative_numbers_may_have_exponents(capsys: Captured) -> None:
    assert code("solve", THREE, "-1.25e-1", "-5E-2", "0.3", "--direction", "-1e-1", "0", "1") == 0
    with_exponents = capsys.readouterr().out
    assert code("solve", THREE, "-0.125", "-0.05", "0.3", "--direction", "-0.1", "0", "1") == 0
    assert capsys.readouterr().out == with_exponents


def test_solve_turns_the_tip_all_the_way(capsys: Captured) -> None:
    arm = load_arm(THREE)
    pose = arm_pose(np.array([[0.3, 0.5], [-0.4, 0.2], [0.1, 0.6]]), arm)
    quaternion = Rotation.from_matrix(pose[:3, :3]).as_quat()
    assert code("solve", THREE, *pose[:3, 3], "--quaternion", *quaternion, "--json") == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["status"] == "SOLVED"
    np.testing.assert_allclose(arm_pose(np.array(answer["configuration"]), arm), pose, atol=3e-6)


def test_solve_answers_a_file_of_targets(capsys: Captured, tmp_path: Path) -> None:
    file = tmp_path / "targets.csv"
    file.write_text("# x, y, z [m]\n0.1, 0.0, 0.4\n0.0, 0.0, 3.0  # too far\n\n")
    assert code("solve", THREE, "--targets", file, "--json") == 1
    answers = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [answer["status"] for answer in answers] == ["SOLVED", "UNREACHABLE"]
    file.write_text("0.1 0 0.4 0 0 1\n")
    assert code("solve", THREE, "--targets", file) == 0
    assert "degrees off its direction" in capsys.readouterr().out


def test_solve_stays_near_a_start_and_bends_little(capsys: Captured) -> None:
    arm = load_arm(THREE)
    start = [50.0, 10.0, 60.0, -40.0, 55.0, 90.0]
    w = allen_from_jones(np.radians(start[1::2]), np.radians(start[0::2]))
    point, found = arm_pose(w, arm)[:3, 3], {}
    for objective in ("near_start", "least_bending"):
        assert code("solve", THREE, *point, "--start", *start, "--objective", objective, "--json") == 0
        found[objective] = np.array(json.loads(capsys.readouterr().out)["configuration"])
    np.testing.assert_allclose(found["near_start"], w, atol=1e-5)
    assert np.linalg.norm(found["least_bending"]) < 0.99 * np.linalg.norm(w)


def test_millimetres_are_suspected(capsys: Captured) -> None:
    assert code("solve", THREE, 100, 0, 400) == 1
    assert "millimetres?" in capsys.readouterr().out
    assert code("solve", THREE, 0, 0, 2) == 1
    assert "millimetres?" not in capsys.readouterr().out


@pytest.mark.parametrize("text", ["", "1 2\n", "1 2 3\n1 2 3 4 5 6\n", "a b c\n"])
def test_a_file_without_targets_is_refused(capsys: Captured, tmp_path: Path, text: str) -> None:
    file = tmp_path / "targets.txt"
    file.write_text(text)
    assert refused(capsys, "solve", THREE, "--targets", file).startswith(f"{file}: holds no targets")
    assert "cannot be read" in refused(capsys, "solve", THREE, "--targets", tmp_path)


def test_a_target_out_of_reach_is_no(capsys: Captured) -> None:
    assert code("solve", THREE, 0, 0, 2) == 1
    output = capsys.readouterr().out
    assert "not reached: out of reach" in output
    distance = float(re.search(r"the tip is (\S+) mm", output)[1])
    assert distance == pytest.approx(2000 - 1e3 * load_arm(THREE).length, rel=1e-2)


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (("nan", 0, 0), "position is [nan, 0.0, 0.0]; allowed: three finite numbers"),
        ((0, "inf", 0), "position is [0.0, inf, 0.0]"),
        ((0, 0, 0.3, "--direction", 0, 0, 0), "direction is [0.0, 0.0, 0.0]"),
        ((0, 0, 0.3, "--tolerance", 0), "--tolerance is 0.0; allowed: a number > 0"),
        ((0, 0, 0.3, "--tolerance", "nan"), "--tolerance is nan"),
        ((0, 0, 0.3, "--quaternion", 0, 0, 0, 0), "--quaternion is [0.0, 0.0, 0.0, 0.0]"),
        ((0, 0, 0.3, "--quaternion", 0, 0, 0, 1, "--direction", 0, 0, 1), "directions is"),
        ((0, 0, 0.3, "--start", 10, 20), "--start is [10.0, 20.0]; allowed: bend and azimuth of each of 3"),
        ((0, 0, 0.3, "--start", *[0] * 5, "nan"), "--start is"),
    ],
)
def test_solve_refuses_values(capsys: Captured, words: tuple[object, ...], problem: str) -> None:
    assert refused(capsys, "solve", THREE, *words).startswith(problem)

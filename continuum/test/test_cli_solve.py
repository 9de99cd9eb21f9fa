"""`continuum solve`: targets from the command line or a file, answers as a table or as JSON."""

import json
from pathlib import Path

import numpy as np
import pytest
from command_line import THREE, Captured, code, refused, rows_of
from scipy.spatial.transform import Rotation

from continuum.arm import load_arm
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import allen_from_jones
from continuum.kinematics.routing import tangle


def test_solve_prints_a_posture_that_reaches_the_point(capsys: Captured) -> None:
    target = [0.15, 0.05, 0.20]
    assert code("solve", THREE, *target) == 0
    output = capsys.readouterr().out
    arm = load_arm(THREE)
    assert output.startswith("reached; the tip is ")
    assert max(map(len, output.splitlines())) <= 80
    figures = np.array([row[1:] for row in rows_of(output, [s.name for s in arm.sections])], dtype=float)
    w = allen_from_jones(np.radians(figures[:, 1]), np.radians(figures[:, 0]))
    np.testing.assert_allclose(arm_pose(w, arm)[:3, 3], target, atol=2e-4)
    lengths = rows_of(output, list(arm.cable_names))
    assert [name for name, _ in lengths] == list(arm.cable_names)
    np.testing.assert_allclose([float(length) for _, length in lengths], 1e3 * tangle(w, arm), atol=0.05)
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
    w = np.array(answer["configuration"])
    np.testing.assert_allclose(arm_pose(w, arm), pose, atol=3e-6)
    np.testing.assert_allclose(answer["target"]["position"], pose[:3, 3])
    np.testing.assert_allclose(answer["target"]["rotation"], pose[:3, :3], atol=1e-12)
    assert answer["sections"] == [section.name for section in arm.sections]
    assert answer["cable_lengths"] == pytest.approx(dict(zip(arm.cable_names, tangle(w, arm), strict=True)))


def test_solve_answers_a_file_of_targets(capsys: Captured, tmp_path: Path) -> None:
    file = tmp_path / "targets.csv"
    file.write_text("# x, y, z [m]\n0.1, 0.0, 0.4\n0.0, 0.0, 3.0  # too far\n\n")
    assert code("solve", THREE, "--targets", file, "--json") == 1
    answers = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [answer["status"] for answer in answers] == ["SOLVED", "UNREACHABLE"]
    assert code("solve", THREE, "--targets", file) == 1
    output = capsys.readouterr().out
    assert "target 1 of 2, 0.1 0 0.4 m:\nreached;" in output
    assert "target 2 of 2, 0 0 3 m:\nnot reached: out of reach;" in output
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


def test_a_start_beyond_a_limit_is_reported(capsys: Captured) -> None:
    assert code("solve", THREE, 0.1, 0, 0.4, "--start", 10, 0, -200, 0, 180, 0) == 0
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("continuum: --start bends section_2 by 200 degrees; its limit is 180")


def test_a_direction_next_to_a_file_is_wrong_usage(capsys: Captured, tmp_path: Path) -> None:
    file = tmp_path / "targets.txt"
    file.write_text("0.1 0 0.4\n")
    assert code("solve", THREE, "--targets", file, "--direction", 0, 0, 1) == 2
    assert "--direction and --quaternion belong to X Y Z" in capsys.readouterr().err


def test_millimetres_are_suspected(capsys: Captured) -> None:
    assert code("solve", THREE, 100, 0, 400) == 1
    assert "millimetres?" in capsys.readouterr().out
    assert code("solve", THREE, 0, 0, 2) == 1
    assert "millimetres?" not in capsys.readouterr().out


@pytest.mark.parametrize("heading", ["x,y,z", "x_m, y_m, z_m, dx, dy, dz", "# X Y Z\nX Y Z qx qy qz qw"])
def test_a_file_of_targets_may_have_a_heading(capsys: Captured, tmp_path: Path, heading: str) -> None:
    file = tmp_path / "targets.csv"
    columns = len(heading.splitlines()[-1].replace(",", " ").split())
    file.write_text(f"\ufeff{heading}\n{' '.join(['0.1', '0', '0.4', '0', '0', '0', '1'][: columns - 1])} 1\n")
    code("solve", THREE, "--targets", file, "--json")
    answer = json.loads(capsys.readouterr().out)
    assert answer["target"]["position"][:2] == [0.1, 0.0]
    assert set(answer["target"]) == {"position", *{6: ["direction"], 7: ["rotation"]}.get(columns, [])}


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
@pytest.mark.parametrize("text", ['"x","y","z"\n"0.1","0","0.4"\n', "x;y;z;\n0,100;0,000;0,400;\n", "0.1,0,0.4,\n"])
def test_targets_say_the_same_however_they_were_written(
    capsys: Captured, tmp_path: Path, text: str, encoding: str
) -> None:
    file = tmp_path / "targets.csv"
    file.write_text("# at the h\u00f6he of the tip\n" + text, encoding=encoding)
    code("solve", THREE, "--targets", file, "--json")
    assert json.loads(capsys.readouterr().out)["target"]["position"] == [0.1, 0.0, 0.4]


@pytest.mark.parametrize("separator", [" ", ",", ";", "\t"])
def test_columns_of_targets_may_stand_in_any_order(capsys: Captured, tmp_path: Path, separator: str) -> None:
    names, values = ["x", "y", "z", "qx", "qy", "qz", "qw"], ["0.1", "0", "0.4", "0.1", "0.2", "0.3", "0.9"]
    answers = []
    for order in (range(7), (6, 0, 1, 2, 3, 5, 4)):
        file = tmp_path / "targets.csv"
        file.write_text("".join(separator.join(row[k] for k in order) + "\n" for row in (names, values)))
        code("solve", THREE, "--targets", file, "--json")
        answers.append(json.loads(capsys.readouterr().out)["target"])
    assert answers[0] == answers[1]


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "contains no targets"),
        ("x y z\n", "contains no targets"),
        ("1 2\n", "line 1 has 2 columns; expected are lines of 3"),
        ("\n1 2 3\n1 2 3 4 5 6\n", "line 3 has 6 columns; expected are lines of 3"),
        ("a b c\n", "line 1 names the columns a b c; allowed: x y z"),
        ("0,1 0,2 0,3\n", "line 1: decimal commas between blanks?"),
        ("x y z\n1 2 3 4\n", "line 2 has 4 columns, the heading 3"),
        ("x y z\n1 2 3\n# four\n1 nan 3\n", "line 4: 'nan'; allowed: a finite number"),
        ("1 2 3 0 0 1\n1 2 3 0 0 0\n", "line 2: a direction of nothing but zeros"),
        ("1 2 3 0 0 0 0\n", "line 1: a quaternion of nothing but zeros"),
        ("0.1,,0.2,0.3\n", "line 1 has 4 columns"),
        ("x,y,z\n0.1,,0.2\n", "line 2: ''; allowed: a finite number"),
        ("0,15,0,05,0,25\n", "line 1: decimal commas between commas?"),
        ("0.1 1_0 0.2\n", "line 1: '1_0' is not a number"),
    ],
)
def test_a_file_without_targets_is_refused_by_its_line(
    capsys: Captured, tmp_path: Path, text: str, problem: str
) -> None:
    file = tmp_path / "targets.txt"
    file.write_text(text)
    assert refused(capsys, "solve", THREE, "--targets", file).startswith(f"{file}: {problem}")
    assert "cannot be read" in refused(capsys, "solve", THREE, "--targets", tmp_path)


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (("nan", 0, 0), "position is [nan, 0.0, 0.0]; allowed: three finite numbers"),
        ((0, 0, 0.3, "--tolerance", 0), "--tolerance is 0.0; allowed: a number > 0"),
        (
            (0, 0, 0.3, "--quaternion", 0, 0, 0, 1, "--direction", 0, 0, 1),
            "--direction is [0.0, 0.0, 1.0]; allowed: none",
        ),
        (
            (0, 0, 0.3, "--start", 10, 20),
            "--start is [10.0, 20.0]; allowed: finite numbers, bend and azimuth of each of 3",
        ),
    ],
)
def test_solve_refuses_values(capsys: Captured, words: tuple[object, ...], problem: str) -> None:
    assert refused(capsys, "solve", THREE, *words).startswith(problem)

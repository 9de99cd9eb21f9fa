"""`continuum simulate`: what it writes is what it simulated, and goes in again; what it cannot use it names."""

import csv
import math
import re
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from dynamics_laws import energies
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from continuum.cli import main
from continuum.cli.negative_numbers import written_out
from continuum.cli.simulate import release_posture
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model import ActiveEffect
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.planar.backbone import backbone
from continuum.dynamics.pulled_posture import pulled_posture
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.errors import FileError, InvalidValueError
from continuum.estimation.structure import absent_values
from continuum.recordings.input_table import read_tension_table, read_torque_table
from continuum.recordings.motion_figure import write_motion_figure

pytestmark = pytest.mark.slow

MODEL = load_model("lamecc_prototype.yaml")
HEADING = [
    "t_s", *(f"q{i}_deg" for i in range(1, 6)), *(f"dq{i}_deg_s" for i in range(1, 6)), "u1_N", "u2_N"
]  # fmt: skip


def table(path) -> tuple[list[str], np.ndarray]:
    with path.open(newline="") as file:
        heading, *rows = csv.reader(file)
    return heading, np.array(rows, dtype=float)


def test_a_release_loses_energy(tmp_path, capsys):
    assert main(["simulate", "--release", "90", "--csv", str(tmp_path / "release.csv")]) == 0
    heading, rows = table(tmp_path / "release.csv")
    assert heading == HEADING
    np.testing.assert_allclose(rows[:, 0], np.arange(193) / 120, atol=1e-9)
    assert rows[0, 1:].tolist() == [18.0] * 5 + [0.0] * 7
    states = np.radians(rows[:, 1:11])
    left = np.sum(energies(states, MODEL), axis=0)
    assert np.all(np.diff(left) < 1e-6)
    assert left[0] - left[-1] > 0.1
    assert "bend in total   90.00 degrees at first" in capsys.readouterr().out


def test_sensors_read_what_the_model_says(tmp_path):
    """An offset is added; readings that are late are those of a later beginning."""
    offset, delay, n = effect_named("angle_offset"), effect_named("sensor_delay"), MODEL.n_joints
    late = {"plain": 0.0, "late": 3 / 120}
    for name, seconds in late.items():
        effects = (
            ActiveEffect(offset, absent_values(offset, n) | {"offset": np.array([0.0, 0.05, 0.0, 0.0, 0.0])}),
            ActiveEffect(delay, {"delay": np.array([seconds])}),
        )
        save_model(replace(MODEL, effects=effects), tmp_path / f"{name}.yaml")
        order = ["simulate", "--release", "60", "--model", str(tmp_path / f"{name}.yaml"), "--csv"]
        assert main([*order, str(tmp_path / f"{name}.csv")]) == 0
    plain, delayed = (table(tmp_path / f"{name}.csv")[1][:, 1:11] for name in late)
    bend = np.full(5, 12.0)
    bend[1] += math.degrees(0.05)
    np.testing.assert_allclose(plain[0, :5], bend, atol=1e-6)
    np.testing.assert_allclose(delayed[3:], plain[:-3], atol=1e-5)
    np.testing.assert_allclose(delayed[:4, :5], np.tile(bend, (4, 1)), atol=1e-5)


def test_what_is_written_goes_in_again(tmp_path):
    """Tensions whose knots are output times: the table of the simulation is a table of its tensions."""
    knots = "u2_N,t_s,u1_N,note\n0,0,0,begin\n1.5,0.25,14,\n0,0.5,0,\n0,0.75,0,end\n"
    (tmp_path / "tensions.csv").write_text(knots)
    first, again = tmp_path / "first.csv", tmp_path / "again.csv"
    assert main(["simulate", "--tensions", str(tmp_path / "tensions.csv"), "--csv", str(first)]) == 0
    assert main(["simulate", "--tensions", str(first), "--csv", str(again)]) == 0
    rows = table(first)[1]
    assert rows[-1, 0] == 0.75
    assert rows[:, 11].max() == 14.0
    assert rows[30, 11:].tolist() == [14.0, 1.5]
    np.testing.assert_allclose(table(again)[1], rows, atol=0.05, rtol=2e-3)  # knots end steps in other places
    np.testing.assert_allclose(read_tension_table(first).values, rows[:, 11:])


def test_torques_that_are_written_go_in_again(tmp_path):
    """Held against gravity by its own weight's moment, an arm stays; driven otherwise, it moves as its table says."""
    arm, knots, out = (tmp_path / name for name in ("arm.yaml", "knots.csv", "out.csv"))
    values = {"joints": 2, "link-length": "0.3,0.2", "mass": "0.5,0.6", "center-of-mass": "0.3,0.2", "inertia": "0,0"}
    words = [part for name, value in values.items() for part in (f"--{name}", str(value))]
    assert main(["model", "new", *words, "--out", str(arm)]) == 0
    hold = 9.81 * np.array([0.5 * 0.3 + 0.6 * 0.5, 0.6 * 0.2])  # both links level
    knots.write_text("t_s,tau1_Nm,tau2_Nm\n" + "".join(f"{t},{hold[0]:.12f},{hold[1]:.12f}\n" for t in (0, 0.5)))
    order = ["simulate", "--model", str(arm), "--release", "90,0", "--csv", str(out), "--torques"]
    assert main([*order, str(knots)]) == 0
    heading, rows = table(out)
    assert heading[-2:] == ["tau1_Nm", "tau2_Nm"]
    np.testing.assert_allclose(rows[:, 1:5], np.tile([90.0, 0, 0, 0], (61, 1)), atol=0.05)
    knots.write_text("t_s,tau1_Nm,tau2_Nm\n0,0,0\n0.25,-1,0.5\n0.5,1,0\n")
    assert main([*order, str(knots)]) == 0
    first = table(out)[1]
    (tmp_path / "first.csv").write_text(out.read_text())
    assert main([*order, str(tmp_path / "first.csv")]) == 0
    np.testing.assert_allclose(table(out)[1], first, atol=0.02, rtol=2e-3)


@pytest.mark.parametrize(
    "text", ["t_s,tau1_Nm\n0,1\n", "t_s,tau1_Nm,tau2_Nm,tau3_Nm\n0,1,1,1\n", "t_s,tau1_Nm,tau2_Nm\n"]
)
def test_a_table_of_torques_has_one_for_each_joint(tmp_path, text):
    (tmp_path / "torques.csv").write_text(text)
    with pytest.raises(FileError):
        read_torque_table(tmp_path / "torques.csv", 2)


def test_torques_are_refused_where_cables_pull(tmp_path, capsys):
    (tmp_path / "torques.csv").write_text("t_s,tau1_Nm\n0,1\n")
    assert main(["simulate", "--torques", str(tmp_path / "torques.csv")]) == 2
    assert "joint torques" in capsys.readouterr().err


def test_both_integrators_and_a_model_file_agree(tmp_path):
    save_model(MODEL, tmp_path / "model.yaml")
    found = []
    for integrator in ("esdirk", "bdf"):
        out = tmp_path / f"{integrator}.csv"
        options = ["--model", str(tmp_path / "model.yaml"), "--duration", "0.5", "--rate", "60", "--csv", str(out)]
        assert main(["simulate", "--release", "-11,-13,-20,-16,-15", "--integrator", integrator, *options]) == 0
        found.append(table(out)[1])
    assert found[0].shape == (31, 13)
    np.testing.assert_allclose(found[0][:, :6], found[1][:, :6], atol=0.1)


def test_a_posture_that_a_cable_holds_is_one_where_it_stays(tmp_path, capsys):
    """Held by the stated tension, the arm hardly moves from the start of its release; when cut, it does."""
    out = tmp_path / "cut.csv"
    assert main(["simulate", "--release", "-90", "--pulled", "--csv", str(out)]) == 0
    output = capsys.readouterr().out
    tension = re.search(r"held by +([\d.]+) N", output)[1]
    first, last = table(out)[1][[0, -1]]
    assert first[1:6].sum() == pytest.approx(-90, abs=1e-6)
    assert abs(last[1:6].sum()) < 10
    (tmp_path / "held.csv").write_text(f"t_s,u1_N,u2_N\n0,0,{tension}\n")
    posture = ",".join(f"{angle:.9f}" for angle in first[1:6])
    held = tmp_path / "held_motion.csv"
    assert main(["simulate", f"--release={posture}", "--tensions", str(tmp_path / "held.csv"), "--csv", str(held)]) == 0
    assert np.abs(table(held)[1][:, 1:6] - first[1:6]).max() < 1.0


def test_a_cable_does_not_push():
    """An arm on a tilted base hangs bent to one side: no cable of that side brings it half of the way back."""
    tilted = MODEL.with_values({"hang_angle": 0.5})
    hangs = pulled_posture(tilted, 1e-9).tension
    assert hangs[0] > 1.0
    assert hangs[1] == 0.0
    with pytest.raises(InvalidValueError, match=r"total bend is -0\.1; allowed: a bend"):
        pulled_posture(tilted, -0.1)


def test_a_picture_has_a_panel_of_tensions_where_there_are_any(tmp_path):
    motion = Simulator(MODEL).run(np.zeros(5), np.linspace(0, 0.1, 3))
    for tension in (0.0, 2.0):
        path = tmp_path / f"{tension}.svg"
        write_motion_figure(motion, Tensions(np.zeros(1), np.array([[tension, 0.0]])), MODEL.parameters, path)
        assert ("Cable tensions at the base" in path.read_text()) == (tension > 0)


def test_the_backbone_is_as_long_as_the_arm_and_hangs_down():
    p = MODEL.parameters
    points = backbone(np.radians([10, -5, 20, 5, 60.0]), p)
    assert points.shape == (7, 2)
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    np.testing.assert_allclose(lengths, [0.01925, *[0.0385] * 4, 0.01925])
    last = np.diff(points, axis=0)[-1] / lengths[-1]
    np.testing.assert_allclose(last, [1.0, 0.0], atol=1e-12)  # a quarter turn from straight down, to the positive side
    np.testing.assert_allclose(backbone(np.zeros(5), p)[-1], [0.0, -0.1925], atol=1e-12)


BAD_TENSIONS = {
    "word": ("t_s,u1_N,u2_N\n0,1,2\n0.1,much,2\n", "row 3: u1_N is 'much'; allowed: a finite number >= 0"),
    "NaN": ("t_s,u1_N,u2_N\n0,1,nan\n", "row 2: u2_N is 'nan'"),
    "infinite time": ("t_s,u1_N,u2_N\ninf,1,1\n", "row 2: t_s is 'inf'; allowed: a finite number"),
    "push": ("t_s,u1_N,u2_N\n0,1,2\n\n0.1,1,-3\n", "row 4: u2_N is '-3'"),
    "time goes back": ("t_s,u1_N,u2_N\n0,1,1\n\n0.2,1,1\n0.1,1,1\n", "row 5: t_s 0.1 is not after 0.2"),
    "column twice": ("t_s,u1_N,u2_N,u1_N\n0,1,1,1\n", "has more than one column u1_N"),
    "heading alone": ("t_s,u1_N,u2_N\n", "has no rows"),
}


@pytest.mark.parametrize("case", BAD_TENSIONS)
def test_a_bad_table_of_tensions_is_refused_by_its_row(case, tmp_path, capsys):
    content, expected = BAD_TENSIONS[case]
    path = tmp_path / "tensions.csv"
    path.write_text(content)
    assert main(["simulate", "--tensions", str(path)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"continuum: {path}: {expected}")


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.binary(max_size=80) | st.text("0123456789.,-+eNat_su12\n \r\"'", max_size=80).map(str.encode))
def test_any_bytes_are_tensions_or_a_file_error(tmp_path, content):
    path = tmp_path / "any.csv"
    path.write_bytes(b"t_s,u1_N,u2_N\n" + content)
    with suppress(FileError):
        assert isinstance(read_tension_table(path), Tensions)


BAD_OPTIONS = {
    "no number": (["--release", "much"], "--release is 'much'; allowed: a total bend, or 5 joint angles"),
    "angles of another arm": (["--release", "1,2,3"], "--release is '1,2,3'"),
    "round and round": (["--release", "1e9"], "--release is '1e9'"),
    "backwards": (["--duration", "-1"], "--duration is -1.0; allowed: a number > 0 [s]"),
    "no rate": (["--rate", "0"], "--rate is 0.0; allowed: a number > 0 [Hz]"),
    "endless": (["--duration", "1e9"], "--duration times --rate is"),
    "no sample": (["--duration", "0.001"], "--duration times --rate is 0.12"),
    "no model": (["--model", "nowhere.yaml"], "nowhere.yaml: "),
    "no tensions": (["--tensions", "nowhere.csv"], "nowhere.csv: cannot be read"),
    "no folder": (["--duration", "0.05", "--csv", "/dev/null/a.csv"], "/dev/null/a.csv: cannot be written (Not a"),
    "no such format": (["--duration", "0.05", "--picture", "a.xyz"], "a.xyz: cannot be drawn (format 'xyz'"),
    "pulled by nothing": (["--pulled"], "--pulled needs --release, one total bend in degrees"),
    "pulled to angles": (["--pulled", "--release", "1,2,3,4,5"], "--release is '1,2,3,4,5'; allowed: with --pulled"),
}


HINTS = {
    "radians": (["--release", "1.57"], None, "--release is in degrees, and 1.57 in total is little: were these rad"),
    "too far": (["--release", "400"], None, "at the start joint 1 is bent by 80 degrees; "),
    "millinewtons": ([], "t_s,u1_N,u2_N\n0,0,0\n1,20000,0\n", "tensions are in newtons, and 20000 N is more than "),
    "milliseconds": ([], "t_s,u1_N,u2_N\n0,1,0\n100,2,0\n200,0,0\n", "t_s is in seconds, and 200 s are simulated: we"),
}


@pytest.mark.parametrize("case", HINTS)
def test_other_units_are_suspected(case, tmp_path, capsys):
    options, content, expected = HINTS[case]
    if content is not None:
        (tmp_path / "tensions.csv").write_text(content)
        options = ["--tensions", str(tmp_path / "tensions.csv")]
    main(["simulate", *options, "--rate", "10"])
    assert capsys.readouterr().err.startswith(f"continuum: {expected}")


def test_usual_units_are_not_suspected(tmp_path, capsys):
    (tmp_path / "tensions.csv").write_text("t_s,u1_N,u2_N\n0.1,20,0\n1,0,5\n")
    assert main(["simulate", "--release", "90", "--tensions", str(tmp_path / "tensions.csv")]) == 0
    assert capsys.readouterr().err == ""


def test_what_no_joint_can_do_is_not_written(tmp_path, capsys):
    (tmp_path / "tensions.csv").write_text("t_s,u1_N,u2_N\n0,0,0\n1,20000,0\n")
    out = tmp_path / "out.csv"
    assert main(["simulate", "--tensions", str(tmp_path / "tensions.csv"), "--csv", str(out)]) == 1
    assert "no joint bends by more than half a turn; nothing is written" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize("case", BAD_OPTIONS)
def test_bad_options_are_refused_in_one_line(case, capsys):
    options, expected = BAD_OPTIONS[case]
    assert main(["simulate", *options]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"continuum: {expected}")


def test_a_simulation_that_fails_says_so(tmp_path, capsys):
    wild = {"hole_radius": 10.0, "half_spacing": 10.0, "capstan_friction": 2.0, "cable_slope": 1e6}
    save_model(MODEL.with_values(wild), tmp_path / "wild.yaml")
    (tmp_path / "pull.csv").write_text("t_s,u1_N,u2_N\n0,0,0\n0.01,10000,0\n1,10000,0\n")
    out = tmp_path / "out.csv"
    options = ["--model", str(tmp_path / "wild.yaml"), "--tensions", str(tmp_path / "pull.csv"), "--csv", str(out)]
    assert main(["simulate", *options]) == 1
    assert "no step was small enough" in capsys.readouterr().out
    assert not out.exists()


@given(st.lists(st.floats(-180, 180), min_size=5, max_size=5))
def test_angles_of_each_joint_are_taken_as_they_are(angles):
    text = ",".join(map(str, angles))
    (option,) = written_out(["--release", text]) if angles[0] < 0 or text.startswith("-") else [f"--release={text}"]
    assert option == f"--release={text}"
    np.testing.assert_allclose(release_posture(text, 5), np.radians(angles))
    assert written_out(["--bend=9", "-1,2"]) == ["--bend=9", "-1,2"]  # an option that has its value takes no other


def test_a_bend_is_shared_by_all_joints():
    np.testing.assert_allclose(release_posture("-90", 3), [-math.pi / 6] * 3)
    with pytest.raises(InvalidValueError):
        release_posture("541", 3)

"""`continuum curvature`: recordings of simulated arms to the end, what is written, and mistakes in one line."""

import json
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import Captured, code, refused
from curvature_runs import RATE, stops

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus

pytestmark = pytest.mark.slow

MODEL = load_model("lamecc_prototype.yaml")
KNOTS = [0.0, 1.5, 4.0, 5.0, 7.5], [0.0, 20.0, 20.0, 12.0, 12.0]  # [s], [N]


@lru_cache
def pulled(side: int = 1) -> tuple[Array, Array, Array]:
    """Times, joint angles and tensions of a simulated arm that one cable pulls, holds, and lets back in part."""
    times = np.arange(int(KNOTS[0][-1] * RATE) + 1) / RATE
    pull = np.outer(np.interp(times, *KNOTS), [side > 0, side < 0])
    run = Simulator(MODEL).run(np.zeros(MODEL.n_joints), times, Tensions(times, pull))
    assert run.status is SimulationStatus.COMPLETE
    return times, run.theta, pull


def file_of(
    folder: Path, times: Array, theta: Array, pull: Array | None, white: float = 0.1, name: str = "run"
) -> Path:
    """A recording with white noise [degrees]."""
    noise = white * np.random.default_rng(5).standard_normal(theta.shape)
    columns, head = (
        [times[:, None], np.degrees(theta) + noise],
        ["t_s", *(f"q{j + 1}_deg" for j in range(theta.shape[1]))],
    )
    if pull is not None:
        columns, head = [*columns, pull], [*head, "u1_N", "u2_N"]
    rows = [",".join(f"{value:.6f}" for value in row) for row in np.hstack(columns)]
    path = folder / f"{name}.csv"
    path.write_text("\n".join([",".join(head), *rows, ""]))
    return path


def one_joint() -> Model:
    p = MODEL.parameters
    return Model(Parameters(**{name: np.asarray(value)[:1] for name, value in p.named().items()}))


def answered(folder: Path, *words: object) -> dict[str, Any]:
    out = folder / "answer.json"
    assert code("curvature", *words, "--json", out) == 0
    found: dict[str, Any] = json.loads(out.read_text())
    return found


def words_of(capsys: Captured) -> str:
    """What was printed, whatever the breaks of its lines."""
    return " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize("recorded", [True, False])
@pytest.mark.parametrize("side", [1, -1])
def test_a_simulated_arm_is_nearer_to_the_dynamic_model(
    capsys: Captured, tmp_path: Path, side: int, recorded: bool
) -> None:
    times, theta, pull = pulled(side)
    found = answered(tmp_path, file_of(tmp_path, times, theta, pull if recorded else None))
    last = found["holds"][-1]
    assert found["overall"]["nearer"] == last["nearer"] == "dynamic model"
    assert last["bent_last"] == -side
    assert last["beyond_friction"] == []
    assert (last["recorded_tension"] is None) == (not recorded)
    assert np.degrees(last["angles_to_dynamic"]["value"]) < 1.5 < np.degrees(last["angles_to_constant"]["value"])
    text = words_of(capsys)
    assert "The dynamic model is nearer by" in text
    assert ("No tension was recorded" in text) == (not recorded)


def test_the_answer_for_machines_holds_the_true_angles_and_the_table_repeats_it(tmp_path: Path) -> None:
    times, theta, pull = pulled()
    table = tmp_path / "angles.csv"
    found = answered(tmp_path, file_of(tmp_path, times, theta, pull), "--csv", table)
    rows = [line.split(",") for line in table.read_text().splitlines()]
    for number, hold in enumerate(found["holds"], start=1):
        inside = (times >= hold["begin"]) & (times <= hold["end"])
        true, measured = np.median(theta[inside], axis=0), hold["measured"]
        assert np.all((np.array(measured["low"]) < true) & (true < np.array(measured["high"])))
        assert sum(hold["constant_curvature"]) == pytest.approx(sum(measured["median"]))
        assert sum(hold["dynamic_model"]["angles"]) == pytest.approx(sum(measured["median"]), abs=1e-6)
        angles = [float(row[rows[0].index("measured_deg")]) for row in rows[1:] if row[1] == str(number)]
        np.testing.assert_allclose(angles, np.degrees(measured["median"]), rtol=0, atol=1e-3)
    assert len(rows) == 1 + 5 * len(found["holds"])


def test_an_arm_that_bends_evenly_is_nearer_to_constant_curvature(capsys: Captured, tmp_path: Path) -> None:
    even = np.radians([[0.0] * 5, [16.0] * 5, [9.0] * 5])
    found = answered(tmp_path, file_of(tmp_path, *stops(even), None))
    assert [hold["nearer"] for hold in found["holds"]] == ["undecided", *["constant curvature"] * 2]
    assert found["overall"]["nearer"] == "constant curvature"
    assert "Constant curvature is nearer by" in words_of(capsys)


def test_sensors_that_are_too_bad_decide_nothing(capsys: Captured, tmp_path: Path) -> None:
    times, theta, pull = pulled()
    found = answered(tmp_path, file_of(tmp_path, times, theta, pull), "--sensor-error", 8)
    assert {hold["nearer"] for hold in found["holds"]} == {found["overall"]["nearer"]} == {"undecided"}
    assert "nearer cannot be decided" in words_of(capsys)


@pytest.mark.parametrize(("factor", "words"), [(1.0, "as recorded."), (0.4, "it needs"), (0.0, "With no tension")])
def test_recorded_tensions_that_do_not_hold_the_bend_are_reported(
    capsys: Captured, tmp_path: Path, factor: float, words: str
) -> None:
    times, theta, pull = pulled()
    found = answered(tmp_path, file_of(tmp_path, times, theta, factor * pull))
    used = [hold["dynamic_model"]["tension"] == hold["recorded_tension"] for hold in found["holds"]]
    assert used == [factor == 1] * len(used)
    assert words in words_of(capsys)
    assert found["overall"]["nearer"] == "dynamic model"


def test_the_picture_is_of_the_hold_that_is_named(capsys: Captured, tmp_path: Path) -> None:
    run, pictures = file_of(tmp_path, *pulled()), [tmp_path / f"{name}.png" for name in "ab"]
    for number, picture in zip((1, 2), pictures, strict=True):
        assert code("curvature", run, "--picture", picture, "--hold", number) == 0
        assert f"Hold {number}, joint angles" in capsys.readouterr().out
    first, second = (picture.read_bytes() for picture in pictures)
    assert first[:4] == second[:4] == b"\x89PNG"
    assert first != second


def test_lines_fit_a_terminal(capsys: Captured, tmp_path: Path) -> None:
    runs = [file_of(tmp_path, *pulled(side), name=f"run_{side}") for side in (1, -1)]
    assert code("curvature", *runs) == 0
    out = capsys.readouterr().out
    assert max(map(len, out.splitlines())) <= 80
    assert "run_-1" in out


def refused_without_a_file(capsys: Captured, folder: Path, *words: object) -> str:
    outputs = [folder / "new" / f"out.{kind}" for kind in ("csv", "json", "png")]
    options = [word for pair in zip(("--csv", "--json", "--picture"), outputs, strict=True) for word in pair]
    message = refused(capsys, "curvature", *words, *options)
    assert not (folder / "new").exists()
    return message


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (["moving"], "number of holds is 0"),
        (["three"], "number of joints is 3"),
        (["rests", "--hold", 0], "--hold is 0"),
        (["rests", "--hold", 99], "--hold is 99"),
        (["rests", "--sensor-error", -1], "--sensor-error is -1"),
        (["rests", "--sensor-error", "nan"], "--sensor-error is nan"),
        (["rests", "--model", "double_pendulum.yaml"], "input of the model is 'joint_torques'"),
        (["torques"], "kind of inputs is 'joint torques'"),
        (["rests", "--model", "one.yaml"], "number of joints is 5"),
        (["single", "--model", "one.yaml"], "number of joints is 1; allowed: 2 or more"),
        (["nowhere"], "cannot be read"),
    ],
)
def test_mistakes_are_reported_in_one_line(
    capsys: Captured, tmp_path: Path, given: Sequence[object], message: str
) -> None:
    times, theta, pull = pulled()
    swing = np.radians(20) * np.sin(5 * times)[:, None] * np.ones(5)
    runs = {
        "moving": file_of(tmp_path, times, swing, None, name="moving"),
        "rests": file_of(tmp_path, times, theta, pull, name="rests"),
        "three": file_of(tmp_path, times, theta[:, :3], pull, name="three"),
        "single": file_of(tmp_path, times, theta[:, :1], pull, name="single"),
        "torques": file_of(tmp_path, times, theta, None, name="torques"),
        "nowhere": tmp_path / "nowhere.csv",
        "one.yaml": tmp_path / "one.yaml",
    }
    if "torques" in given:
        lines = runs["torques"].read_text().splitlines()
        head = lines[0] + "".join(f",tau{j}_Nm" for j in range(1, 6))
        runs["torques"].write_text("\n".join([head, *(f"{line},1,0,0,0,0" for line in lines[1:]), ""]))
    if "one.yaml" in given:
        save_model(one_joint(), runs["one.yaml"])
    words = [runs.get(word, word) if isinstance(word, str) else word for word in given]
    assert message in refused_without_a_file(capsys, tmp_path, *words)


def test_a_recording_without_a_hold_changes_no_figure_and_is_reported(capsys: Captured, tmp_path: Path) -> None:
    rests = file_of(tmp_path, *pulled(), name="rests")
    times = np.arange(0.0, 4.0, 0.01)
    moving = file_of(tmp_path, times, np.radians(20) * np.sin(5 * times)[:, None] * np.ones(5), None, name="moving")
    assert code("curvature", rests) == 0
    alone = capsys.readouterr()
    assert code("curvature", rests, moving) == 0
    both = capsys.readouterr()
    assert both.out == alone.out
    assert "moving" in both.err
    assert "moving" not in alone.err


def test_neither_what_is_read_nor_what_is_written_is_overwritten(capsys: Captured, tmp_path: Path) -> None:
    run = file_of(tmp_path, *pulled())
    before = run.read_bytes()
    for option in ("--csv", "--out", "--json"):
        assert "is read, and would be overwritten" in refused(capsys, "curvature", run, option, run)
    both = ("--csv", tmp_path / "both", "--json", tmp_path / "both")
    assert "would be written twice" in refused(capsys, "curvature", run, *both)
    assert "cannot be drawn" in refused(capsys, "curvature", run, "--picture", tmp_path / "x.foo")
    assert run.read_bytes() == before


def test_an_unknown_option_is_wrong_usage(capsys: Captured) -> None:
    assert "--foo" in refused(capsys, "curvature", "run.csv", "--foo")

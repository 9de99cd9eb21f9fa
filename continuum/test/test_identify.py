"""Identification of springs and friction: runs of known truth, scores, and the command `continuum identify`."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.cli import main
from continuum.cli.identify import chosen_runs
from continuum.discovery.parameter_fit import fit_parameters
from continuum.discovery.report.identification_page import remarks
from continuum.dynamics.model import Model, with_dry_friction
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.errors import InvalidValueError
from continuum.identification.estimate import Estimate
from continuum.identification.free import THESIS_PARAMETERS
from continuum.identification.identified import Identified, with_identified
from continuum.identification.scores import Score, scores
from continuum.identification.swarm import SwarmSettings
from continuum.identification.thesis_swarm import swarm_parameters
from continuum.recordings.recording import Recording

TRUTH = {
    "stiffness": 1.05,
    "viscous_friction": 0.025,
    "coulomb_friction": 0.05,
    "stribeck_gain": 0.9,
    "stribeck_speed": 0.26,
}
NOISE = 1.5e-3  # rad
TIMES = np.arange(144) / 120  # s


def nominal() -> Model:
    return load_model("lamecc_prototype.yaml")


def released(
    model: Model, bends: Sequence[float], noise: float = NOISE, rate: float = 0.3, seed: int = 0
) -> list[Recording]:
    """Releases from the same bend at every joint [degrees], and from rates of some size [rad/s]."""
    simulator, random = Simulator(with_dry_friction(model)), np.random.default_rng(seed)
    runs = []
    for k, bend in enumerate(bends):
        start = np.concatenate([np.radians(np.full(5, bend)), random.normal(0, rate, 5)])
        theta = simulator.run(start, TIMES).theta
        runs.append(Recording(f"run_{k + 1}", TIMES, theta + noise * random.standard_normal(theta.shape)))
    return runs


@pytest.mark.slow
def test_a_fit_finds_the_values_that_runs_were_made_with_and_its_intervals_hold_them() -> None:
    identified = fit_parameters(released(nominal().with_values(TRUTH), (18.0, -14.0, 10.0)), nominal())
    assert [one.name for one in identified.values] == list(THESIS_PARAMETERS)
    for one in identified.values:
        truth, half = TRUTH[one.name], (one.high - one.low) / 2
        assert abs(one.value / truth - 1) < 0.05
        assert abs(one.value - truth) < 1.6 * half  # 1 in 600 by chance
        assert 0 < half < 0.2 * truth
    assert identified.error < identified.limit
    assert not identified.undetermined


@pytest.mark.slow
def test_per_joint_a_stiff_joint_is_found_at_its_place() -> None:
    stiffness = np.full(5, 1.05)
    stiffness[2] *= 1.3
    truth = nominal().with_values(TRUTH | {"stiffness": stiffness})
    identified = fit_parameters(released(truth, (18.0, -14.0, 10.0)), nominal(), per_joint=True)
    found = {one.joint: one.value for one in identified.values if one.name == "stiffness"}
    np.testing.assert_allclose([found[j] for j in range(4)], stiffness[:4], rtol=0.05)
    assert found[4] == pytest.approx(
        stiffness[4], rel=0.15
    )  # carries its own link alone: it creeps back, hardly swings
    np.testing.assert_allclose(identified.model.parameters.stiffness, [found[j] for j in range(5)], rtol=1e-12)


def test_a_model_scores_nothing_on_its_own_runs_and_more_the_farther_its_values_are_off() -> None:
    truth = nominal().with_values(TRUTH)
    runs = released(truth, (15.0,), noise=0.0)
    off = [truth.with_values({"stiffness": TRUTH["stiffness"] * factor}) for factor in (1.0, 1.03, 1.1)]
    exact, near, far = (scores(model, runs)[0] for model in off)
    assert exact.position < 1e-3 < near.position < far.position
    assert exact.rms < np.radians(0.01)
    assert exact.theta.shape == runs[0].theta.shape


def test_initial_rates_are_no_error_of_the_model() -> None:
    run = released(nominal(), (12.0,), noise=0.0)[0]
    later = run.rows(slice(20, None))  # it moves in its first row
    assert scores(nominal(), [later])[0].position < 1e-3


@pytest.mark.slow
def test_a_swarm_is_repeatable_stays_within_a_factor_of_three_and_knows_no_intervals() -> None:
    runs = released(nominal().with_values(TRUTH), (18.0,), rate=0.0)
    few = SwarmSettings(particles=6, iterations=3)
    identified, again = (swarm_parameters(runs, nominal(), seed=1, settings=few) for _ in range(2))
    assert [one.value for one in again.values] == [one.value for one in identified.values]
    for one in identified.values:
        assert 0.05 * one.start <= one.value <= 3.001 * one.start
        assert np.isnan(one.low)
        assert np.isnan(one.high)
        np.testing.assert_allclose(identified.model.values()[one.name], one.value)


def estimate(name: str, value: float, joint: int | None = None) -> Estimate:
    return Estimate(name, joint, "", value, value, value, "", "")


def test_a_value_of_all_joints_keeps_their_proportions_and_is_their_mean() -> None:
    pattern = np.array([1.0, 2.0, 1.5, 1.0, 0.5])
    model = with_identified(nominal().with_values({"stiffness": pattern}), [estimate("stiffness", 3.6)], "test")
    np.testing.assert_allclose(model.parameters.stiffness, 3.0 * pattern)
    assert model.sources["stiffness"] == "test"


def test_a_value_of_one_joint_leaves_the_others_alone() -> None:
    model = with_identified(nominal(), [estimate("stiffness", 3.0, joint=1)], "test")
    expected = np.broadcast_to(nominal().parameters.stiffness, 5).copy()
    expected[1] = 3.0
    np.testing.assert_array_equal(model.parameters.stiffness, expected)


@pytest.mark.parametrize(("error", "warns"), [(0.9, False), (1.019, False), (1.021, True), (3.0, True)])
def test_an_error_beyond_chance_is_warned_of_and_no_other(error: float, warns: bool) -> None:
    run = Recording("run", TIMES, np.zeros((TIMES.size, 5)))
    score = Score(run, run.theta, 0.05, 0.1)
    values = (estimate("stiffness", 1.2),)
    said = " ".join(remarks(Identified("fit", nominal(), values, error, 1.02), [score], [0]))
    assert ("more than chance allows" in said) is warns
    assert ("no more than the sensors' noise" in said) is not warns


def test_a_value_that_the_file_has_none_of_is_not_called_at_its_bound() -> None:
    run = Recording("run", TIMES, np.zeros((TIMES.size, 5)))
    none = replace(estimate("stiffness", 0.0), start=0.0, lower=0.0, upper=1e4)
    bound = replace(none, start=1.0)
    for one, wanted, other in ((none, "Not sought", "At the bound"), (bound, "At the bound", "Not sought")):
        said = " ".join(remarks(Identified("fit", nominal(), (one,), 0.9, 1.0), [Score(run, run.theta, 0.1, 0.1)], [0]))
        assert wanted in said
        assert other not in said


@given(st.integers(2, 9), st.data())
def test_runs_to_identify_from_and_to_predict_are_all_runs(n_runs: int, data: st.DataObject) -> None:
    fitted = data.draw(st.lists(st.integers(0, n_runs - 1), min_size=1, max_size=n_runs - 1, unique=True))
    rest = sorted({*range(n_runs)} - {*fitted})
    to_text = [",".join(str(k + 1) for k in some) for some in (fitted, rest)]
    assert sorted(chosen_runs(to_text[0], None, n_runs)) == sorted(fitted)
    assert sorted(chosen_runs(None, to_text[1], n_runs)) == sorted(fitted)
    assert sorted(chosen_runs(*to_text, n_runs)) == sorted(fitted)
    assert chosen_runs(None, None, n_runs) == [*range(n_runs)]


@pytest.mark.parametrize(
    ("identify", "validate", "n_runs"),
    [
        ("0", None, 3), ("4", None, 3), ("1,1", None, 3), ("", None, 3), ("1.5", None, 3), ("a", None, 3),
        ("-1", None, 3), (None, "1,2,3", 3), ("1,2", "2,3", 3), ("1", "2", 3), (None, "1", 1), ("²", None, 3),
    ],
)  # fmt: skip
def test_runs_that_cannot_be_chosen_are_refused(identify: str | None, validate: str | None, n_runs: int) -> None:
    with pytest.raises(InvalidValueError):
        chosen_runs(identify, validate, n_runs)


def written(runs: Sequence[Recording], folder: Path) -> list[str]:
    paths = []
    for run in runs:
        names = ",".join(["t_s", *(f"q{j + 1}_deg" for j in range(5))])
        rows = np.column_stack([run.times, np.degrees(run.theta)])
        paths.append(str(folder / f"{run.name}.csv"))
        np.savetxt(paths[-1], rows, delimiter=",", header=names, comments="", fmt="%.6f")
    return paths


@pytest.mark.slow
def test_the_command_writes_a_model_that_predicts_a_run_kept_for_validation(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    paths = written(released(nominal().with_values(TRUTH), (18.0, -14.0)), tmp_path)
    model, page = tmp_path / "new" / "model.yaml", tmp_path / "other" / "page.html"
    assert main(["identify", *paths, "--validate", "2", "--out", str(model), "--report", str(page)]) == 0
    printed = capsys.readouterr().out
    assert printed.endswith(f"written: {model}\nwritten: {page}\n")
    kept = [line for line in printed.splitlines() if "validate" in line and "run_2" in line]
    assert len(kept) == 1
    assert float(kept[0].split()[-3]) < 0.2  # NRMSE of position
    assert load_model(str(model)).parameters.stiffness[0] == pytest.approx(TRUTH["stiffness"], rel=0.05)
    assert page.read_text(encoding="utf-8").count('aria-label="joint') == 10


def test_what_cannot_be_identified_is_said_in_one_line_and_nothing_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = released(nominal(), (15.0,))[0]
    (path,), out = written([run], tmp_path), tmp_path / "model.yaml"
    (twin,) = written([replace(run, name="twin")], tmp_path)
    for arguments in (
        [path, "--validate", "1"], [path, "--identify", "2"], [path, twin], [str(tmp_path / "none.csv")],
        [path, "--model", "none.yaml"], [path, "--report", str(tmp_path / "page.txt")],
        [path, "--report", path + "/page.html"], [path, "--seed", "1"],
        [path, "--method", "swarm", "--seed", "-1"], [path, twin, "--method", "swarm"],
    ):  # fmt: skip
        assert main(["identify", *arguments, "--out", str(out)]) == 2
        captured = capsys.readouterr()
        assert captured.err.count("continuum:") == len(captured.err.splitlines()) <= 2
        assert not captured.out
        assert not out.exists()

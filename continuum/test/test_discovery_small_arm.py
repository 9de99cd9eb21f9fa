"""A diagnosis from data to verdict on a small arm, with few effects to choose from; and runs held out."""

from __future__ import annotations

from functools import lru_cache
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from dynamics_laws import prototype_model
from effects_laws import extended as with_effect
from identification_laws import BENDS, FINE, N, recorded, releases, small_simulator, white_noise

from continuum.cli import main
from continuum.discovery.diagnose import Diagnosis, diagnose
from continuum.discovery.findings import Findings, findings
from continuum.discovery.held_out import held_out_misfits
from continuum.discovery.in_words import identifiability_in_words, verdict_in_words
from continuum.discovery.report_html import write_report
from continuum.discovery.residual_torque import residual_torques
from continuum.discovery.structure_tests import StructureTest, structure_tests
from continuum.discovery.trial import TOLERANCES
from continuum.discovery.verdict import Kind
from continuum.discovery.verdict_json import as_mapping
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.simulator import Simulator
from continuum.errors import InvalidValueError
from continuum.identification.arrow_least_squares import Part, reduced
from continuum.identification.dataset import Dataset
from continuum.identification.fit import Fit, fit
from continuum.identification.free import Free
from continuum.identification.recording import Recording
from continuum.identification.window_residual import WindowResidual
from continuum.identification.window_settling import descended
from continuum.identification.windows import WITH_RATES

FREE = (Free("stiffness"), Free("viscous_friction"), Free("coulomb_friction"))
ROUGH = small_simulator(None, TOLERANCES)


def fitted(runs: list[Recording]) -> Fit:
    return fit(ROUGH, runs, white_noise(), FREE)


def density(parts: list[Part], own_spreads: list[np.ndarray], rest: Fit) -> float:
    """Misfit of all windows of a run that a fit has not seen, given what that fit leaves uncertain."""
    slopes = np.concatenate([reduced(part, spread) for part, spread in zip(parts, own_spreads, strict=True)])
    errors = np.concatenate([part.errors for part in parts])
    covariance = np.eye(errors.size) + slopes @ np.linalg.inv(rest.information) @ slopes.T
    return float(errors @ np.linalg.solve(covariance, errors) + np.linalg.slogdet(covariance)[1])


@pytest.mark.parametrize("left_out", range(3))
def test_a_run_is_predicted_as_by_a_fit_without_it(left_out: int) -> None:
    runs = [run.rows(slice(0, 41)) for run in releases(3, small_simulator(), 21, {"stiffness": 1.4})]
    whole = fitted(runs)
    rest = fitted([run for i, run in enumerate(runs) if i != left_out])
    alone = WindowResidual(ROUGH, runs[left_out], 0, white_noise(), rest.space, WITH_RATES)
    first = sum(len(run.rows) for run in whole.runs[:left_out])
    windows = descended(alone, rest.coordinates, whole.unknowns.own[first : first + len(alone.rows)], False)
    assert windows is not None
    refitted = density([at.part for at in windows], alone.spreads, rest)
    predicted, own = held_out_misfits(whole)[left_out], whole.misfits[left_out]
    assert predicted.size == len(windows)
    assert refitted > own.sum()  # what was fitted looks better than it is
    assert predicted.sum() - own.sum() == pytest.approx(
        refitted - own.sum(), rel=0.25, abs=0.5
    )  # decisions are made at 16


def test_uncertain_states_of_effects_are_paid_for_where_a_run_begins() -> None:
    """With nothing shared to fit, all else is predicted as it was fitted."""
    simulator = small_simulator("presliding", TOLERANCES)
    bent = simulator.around(simulator.model.with_values({"presliding.angle": 0.02}))
    runs = [recorded(bent, bend, np.random.default_rng(2)) for bend in BENDS[:2]]
    own = fit(bent, runs, white_noise(), [])
    for predicted, misfits in zip(held_out_misfits(own), own.misfits, strict=True):
        assert predicted[0] > misfits[0] + 1
        np.testing.assert_allclose(predicted[1:], misfits[1:])


def test_one_run_alone_is_held_out_in_stretches() -> None:
    one = fitted(releases(1, small_simulator(), 3))
    pieces = held_out_misfits(one)
    assert len(pieces) > 1
    predicted = np.concatenate(pieces)
    assert predicted.shape == one.misfits[0].shape
    assert predicted.sum() > one.misfits[0].sum()


DRY = {"friction_slope": 1000.0}
TRIED = ("tip_payload", "sensor_delay")


@lru_cache
def simulator(effect: str | None = None) -> Simulator:
    model = prototype_model(N).with_values(DRY)
    return Simulator(model if effect is None else with_effect(model, effect), FINE)


def runs_of(effect: str | None, seed: int, **hidden: float) -> tuple[Recording, ...]:
    random = np.random.default_rng(seed)
    truth = {f"{effect}.{name}": value for name, value in hidden.items()}
    return tuple(
        recorded(simulator(effect), (2 * bend[0], 2 * bend[1]), random, truth, 0.7, name=f"run_{i}")
        for i, bend in enumerate(BENDS)
    )


@lru_cache
def diagnosed(effect: str | None, seed: int, **hidden: float) -> Diagnosis:
    nominal = prototype_model(N)
    return diagnose(Dataset(runs_of(effect, seed, **hidden)), nominal, processes=1, effects=TRIED)


@lru_cache
def payload_found() -> Findings:
    return findings(diagnosed("tip_payload", 3, mass=0.4), np.random.default_rng(0))


def test_a_hidden_payload_is_named_and_its_size_found() -> None:
    found = payload_found()
    assert found.verdict.kind is Kind.CAUSE
    (cause,) = found.verdict.causes
    assert str(cause.addition) == "tip_payload"
    told = as_mapping(found)["causes"][0]["parameters"]["mass"]
    assert abs(told["value"] - 0.4) < told["high"] - told["low"]
    assert told["value"] == pytest.approx(0.4, rel=0.1)
    assert found.closed > 0.5
    assert [score.name for score in found.after] == [f"run_{i}" for i in range(4)]  # as they were given
    assert [score.name for score in found.before] == [f"run_{i}" for i in range(4)]


def test_the_extended_model_is_a_model(tmp_path: Path) -> None:
    found = payload_found()
    save_model(found.model, tmp_path / "extended.yaml")
    loaded = load_model(tmp_path / "extended.yaml")
    for name, values in found.model.values().items():
        np.testing.assert_array_equal(loaded.values()[name], values)
    assert "run_0, run_1" in loaded.sources["tip_payload.mass"]


def test_the_page_tells_the_verdict_and_all_that_it_rests_on(tmp_path: Path) -> None:
    found, diagnosis = payload_found(), diagnosed("tip_payload", 3, mass=0.4)
    torques = residual_torques(diagnosis.question, [found.refitted] * len(found.models))
    tests = structure_tests(torques, np.random.default_rng(0))
    write_report(tmp_path / "page.html", diagnosis, found, (torques, None), tests, "Made by hand.")
    page = unescape((tmp_path / "page.html").read_text(encoding="utf-8"))
    told = (verdict_in_words(found.verdict), *identifiability_in_words(found.identifiability), "Made by hand.")
    for part in (*told, *("<th>extended</th>", "refitted -> extended")):
        assert part in page
    for cell in (*(one.unknown for one in found.estimates), *(run.name for run in found.before)):
        assert f"<td>{cell}</td>" in page
    assert page.count("data:image/png;base64,") == 2 + len(diagnosis.rounds)


@pytest.mark.parametrize("p_value", [0.05, 0.051])
def test_the_page_shows_hints_that_are_more_than_chance_and_no_model_that_is_not_there(
    tmp_path: Path, p_value: float
) -> None:
    diagnosis = diagnosed(None, 2)
    found = findings(diagnosis, np.random.default_rng(0))
    torques = residual_torques(diagnosis.question, found.models)
    tests = [StructureTest(0, "speed", 0.5, p_value), StructureTest(1, "position", 0.1, 0.9)]
    write_report(tmp_path / "page.html", diagnosis, found, (torques, None), tests, "Made by hand.")
    page = unescape((tmp_path / "page.html").read_text(encoding="utf-8"))
    is_hint = p_value == 0.05
    hints = "The surest" if is_hint else "It goes with nothing; this is the outcome"
    assert f">{hints} of 2 comparisons, of which chance puts one in twenty below 0.05" in page
    assert ("<td>speed</td>" in page) == is_hint
    assert "<td>position</td><td>+0.10" not in page
    assert "extended</th>" not in page


@pytest.mark.parametrize("seed", [1, 2, 4])
def test_a_zero_that_is_wrong_alike_in_every_run_is_not_called_a_rest_angle_for_sure(seed: int) -> None:
    """It is one unknown as a rest angle is, and explains all as well."""
    random, truth = np.random.default_rng(seed), {"angle_offset.offset": np.array([0.035, 0.0])}
    runs = tuple(
        recorded(simulator("angle_offset"), (2 * bend[0], 2 * bend[1]), random, truth, 0.7, name=f"run_{i}")
        for i, bend in enumerate(BENDS)
    )
    verdict = diagnose(Dataset(runs), prototype_model(N), processes=1, effects=["rest_angle", "angle_offset"]).verdict
    named = {cause.addition.effect for cause in (*verdict.causes, *verdict.alternatives)}
    assert "angle_offset" in named
    assert verdict.kind is Kind.AMBIGUOUS or named == {"angle_offset"}


def test_data_of_the_model_itself_accuse_nothing() -> None:
    diagnosis = diagnosed(None, 2)
    assert diagnosis.verdict.kind is Kind.ADEQUATE
    assert diagnosis.verdict.extension == ()
    found = findings(diagnosis, np.random.default_rng(0))
    assert found.before == found.after
    low, value, high = next((e.low, e.value, e.high) for e in found.estimates if e.unknown == Free("stiffness"))
    assert low < value < high
    assert low < prototype_model(N).parameters.stiffness[0] < high


def test_one_seed_one_answer() -> None:
    again = findings(diagnosed("tip_payload", 3, mass=0.4), np.random.default_rng(0))
    assert as_mapping(again) == as_mapping(payload_found())


@pytest.mark.parametrize("processes", [0, -2])
def test_a_number_of_processes_that_is_none(processes: int) -> None:
    with pytest.raises(InvalidValueError, match="processes is"):
        diagnose(Dataset(runs_of(None, 0)[:1]), small_simulator().model, processes=processes)


def test_an_arm_of_another_number_of_joints() -> None:
    with pytest.raises(InvalidValueError, match=r"joints of run_\d is 2; allowed: 5, as the model has"):
        diagnose(Dataset(runs_of(None, 0)[:1]), prototype_model(5), processes=1)


def test_the_command_refuses_bad_data_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table = tmp_path / "run.csv"
    table.write_text("t_s,q1_deg\n0,1\n")
    assert main(["diagnose", str(table), "--json", str(tmp_path / "out.json")]) == 2
    told = capsys.readouterr().err
    assert "run.csv: has 1 usable rows" in told
    assert told.count("\n") == 1
    assert not (tmp_path / "out.json").exists()


def test_the_command_tells_what_it_did_not_understand_before_it_searches(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A pulled run whose tensions have another name is another run."""
    table = tmp_path / "run.csv"
    rows = [f"{i / 120},{10 * np.cos(i / 9)},3" for i in range(60)]
    table.write_text("\n".join(["t_s,q1_deg,pull", *rows]))
    monkeypatch.setattr("continuum.cli.diagnose._diagnose", lambda *_: 0)
    assert main(["diagnose", str(table)]) == 0
    assert capsys.readouterr().err == "continuum: run: columns that are not understood, and not used: pull\n"

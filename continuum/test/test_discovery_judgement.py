"""From evidence to a verdict, in words and for machines, on trials made by hand."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from discovery_laws import RUNS, SIZE, WINDOWS, a_round, trial
from dynamics_laws import prototype_model
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.candidate import Addition
from continuum.discovery.evidence import explains_all, gain, is_adequate, unexplained
from continuum.discovery.findings import Estimate, Findings
from continuum.discovery.in_words import cost_in_words, verdict_in_words, worth_in_words
from continuum.discovery.judgement import confirmed, judge
from continuum.discovery.measured_gain import RunScore, closed_gap
from continuum.discovery.verdict import Kind, Verdict
from continuum.discovery.verdict_json import as_mapping, write_json
from continuum.dynamics.effect_lookup import effect_named
from continuum.errors import FileError
from continuum.identification.fisher import Identifiability
from continuum.identification.free import Free
from continuum.identification.recording import Recording

GOOD, BAD = trial(), trial(bad=0.3)
PAYLOAD, TILT, DRAG = trial("tip_payload", seed=1), trial("base_tilt", seed=1), trial("quadratic_drag", seed=2)
HALF = trial("tip_payload", bad=0.15)
WORSE = trial("quadratic_drag", bad=0.28)


@given(st.integers(0, 50), st.integers(0, 50), st.floats(0, 0.5), st.floats(0, 0.5))
def test_what_one_gains_the_other_loses(one: int, other: int, bad: float, worse: float) -> None:
    a, b = trial(bad=bad, seed=one), trial(bad=worse, misfit=1.3, seed=other)
    there, back = gain(a, b), gain(b, a)
    assert there.log_likelihood == pytest.approx(-back.log_likelihood)
    assert there.deviation == pytest.approx(back.deviation)
    assert gain(a, a).log_likelihood == gain(a, a).deviation == 0.0
    assert not (there.is_significant and back.is_significant)
    assert not there.is_significant or there.is_distinct


def test_a_gain_is_half_of_what_the_misfits_fall_by() -> None:
    better = trial(misfit=0.8)
    assert gain(better, GOOD).log_likelihood == pytest.approx((GOOD.misfit - better.misfit) / 2)


def test_a_gain_in_one_stretch_alone_is_chance() -> None:
    """However large: one knock against the arm makes no cause."""
    lucky = trial()
    for run in lucky.held_out[:1]:
        run[:4] = 5 * SIZE
    assert gain(GOOD, lucky).log_likelihood > 15
    assert not gain(GOOD, lucky).is_significant


def test_adequate_is_what_leaves_noise_but_for_a_few_windows() -> None:
    assert unexplained(BAD) == pytest.approx(0.3)
    assert is_adequate(GOOD)
    assert is_adequate(trial(bad=0.03))
    assert not is_adequate(trial(bad=0.08))


def judged() -> dict[Kind, Verdict]:
    """One of each kind."""
    return {
        Kind.ADEQUATE: judge(GOOD, [a_round(GOOD, PAYLOAD)]),
        Kind.CAUSE: judge(BAD, [a_round(BAD, PAYLOAD, WORSE)]),
        Kind.AMBIGUOUS: judge(BAD, [a_round(BAD, PAYLOAD, TILT, WORSE)]),
        Kind.UNKNOWN: judge(BAD, [a_round(BAD, HALF, WORSE)]),
    }


def test_every_kind() -> None:
    for kind, verdict in judged().items():
        assert verdict.kind is kind
        assert bool(verdict.experiment) == (kind is Kind.AMBIGUOUS)
    assert judge(GOOD, []).kind is Kind.ADEQUATE
    assert judge(BAD, []).kind is Kind.UNKNOWN
    assert judge(BAD, [a_round(BAD)]).kind is Kind.UNKNOWN


def test_a_model_that_was_adequate_is_called_so_only_where_nothing_was_added() -> None:
    verdict = judged()[Kind.ADEQUATE]
    assert verdict.causes == ()
    assert verdict.extension == ()
    assert verdict.best is verdict.baseline is GOOD


def test_a_cause_and_what_it_gains() -> None:
    verdict = judged()[Kind.CAUSE]
    (cause,) = verdict.causes
    assert str(cause.addition) == "tip_payload"
    assert cause.gain == gain(PAYLOAD, BAD)
    assert cause.confidence > 0.9
    assert verdict.alternatives == ()
    assert verdict.best is PAYLOAD
    assert verdict.unexplained == (pytest.approx(0.3), 0.0)


def test_causes_that_cannot_be_told_apart_share_the_confidence() -> None:
    verdict = judged()[Kind.AMBIGUOUS]
    named = [*verdict.causes, *verdict.alternatives]
    assert [str(cause.addition) for cause in named] == ["tip_payload", "base_tilt"]
    assert named[0].confidence == pytest.approx(named[1].confidence) == pytest.approx(0.5, abs=0.02)
    for cause in named:
        assert effect_named(cause.addition.effect).experiment in verdict.experiment


def test_confidences_are_shares_and_fall_with_the_evidence() -> None:
    names = ("tip_payload", "base_tilt", "quadratic_drag")
    leaders = [
        trial(name, misfit=m, seed=i) for i, (name, m) in enumerate(zip(names, (1.0, 1.002, 1.005), strict=True))
    ]
    verdict = judge(BAD, [a_round(BAD, *leaders)])
    shares = [cause.confidence for cause in (*verdict.causes, *verdict.alternatives)]
    assert len(shares) == 3
    assert sum(shares) == pytest.approx(1.0)
    assert shares == sorted(shares, reverse=True)
    assert shares[0] > shares[2] + 0.01


def test_what_helps_and_does_not_suffice_is_no_cause() -> None:
    verdict = judged()[Kind.UNKNOWN]
    assert [str(cause.addition) for cause in verdict.causes] == ["tip_payload"]
    assert verdict.unexplained == (pytest.approx(0.3), pytest.approx(0.15))


def test_two_causes_by_two_rounds() -> None:
    both = trial("tip_payload", Addition("rest_angle", (2,)), seed=3)
    verdict = judge(BAD, [a_round(BAD, HALF, WORSE), a_round(HALF, both)])
    assert verdict.kind is Kind.CAUSE
    assert [str(cause.addition) for cause in verdict.causes] == ["tip_payload", "rest_angle@3"]
    assert verdict.best is both


def test_a_cause_is_no_alternative_to_another() -> None:
    """As good as the first one alone, and needed beside it."""
    rival = replace(HALF, extension=(Addition("base_tilt"),))
    both = trial("tip_payload", "base_tilt", seed=3)
    verdict = judge(BAD, [a_round(BAD, HALF, rival), a_round(HALF, both)])
    assert verdict.kind is Kind.CAUSE
    assert [str(cause.addition) for cause in verdict.causes] == ["tip_payload", "base_tilt"]


def test_a_last_round_that_found_nothing_adds_no_cause() -> None:
    verdict = judge(BAD, [a_round(BAD, HALF), a_round(HALF, replace(HALF, extension=(Addition("base_tilt"),)))])
    assert [str(cause.addition) for cause in verdict.causes] == ["tip_payload"]


def test_every_kind_in_words() -> None:
    told = {kind: verdict_in_words(verdict) for kind, verdict in judged().items()}
    assert "as well as the sensors allow" in told[Kind.ADEQUATE]
    assert told[Kind.CAUSE].startswith(effect_named("tip_payload").in_words)
    assert "from 30 % of the data to 0 %" in told[Kind.CAUSE]
    assert "tip_payload, base_tilt" in told[Kind.AMBIGUOUS]
    assert effect_named("base_tilt").experiment in told[Kind.AMBIGUOUS]
    assert "no effect that is known here explains why. tip_payload helps, yet 15 %" in told[Kind.UNKNOWN]
    assert "None even helps" in verdict_in_words(judge(BAD, []))
    at_joints = trial(Addition("rest_angle", (0, 3)), seed=5)
    assert "(joints 1, 4)" in verdict_in_words(judge(BAD, [a_round(BAD, at_joints)]))
    for text in told.values():
        assert 2 <= text.count(". ") + text.endswith(".") <= 6


def test_what_a_simulation_costs_is_told_by_the_usual_run() -> None:
    quick, slow = ([replace(score("run", 0.1), seconds=s) for s in seconds] for seconds in ((0.01, 9.0, 0.01), (0.03,)))
    assert cost_in_words(quick, slow) == "simulating a run takes 30 ms instead of 10 ms"


def test_what_an_extension_is_worth_may_be_less_than_nothing() -> None:
    assert "closes 50 %" in worth_in_words(0.5)
    assert worth_in_words(-0.01).endswith("no better")
    assert "worse" in worth_in_words(-0.1)


RUN = Recording("run_1", np.arange(3) / 120, np.zeros((3, 5)))


def score(name: str, position: float, floor: float = 0.05) -> RunScore:
    return RunScore(name, position, 2 * position, floor, 0.01, None, RUN)


def scores(*positions: float) -> list[RunScore]:
    return [score(f"run_{i}", position) for i, position in enumerate(positions)]


def found(verdict: Verdict) -> Findings:
    """Findings around a verdict."""
    effects = [cause.addition for cause in verdict.causes]
    unknowns = [Free("stiffness"), *(Free(f"{a.effect}.{key}", j) for a in effects
                for key in effect_named(a.effect).parameters for j in a.joints or (None,))]  # fmt: skip
    learnt = Identifiability(tuple(unknowns), np.ones(len(unknowns)), np.eye(len(unknowns)), 10.0, len(unknowns))
    model = prototype_model()
    return Findings(
        verdict=verdict,
        estimates=tuple(Estimate(unknown, 1.0 + i, 0.5 + i, 1.5 + i, "kg") for i, unknown in enumerate(unknowns)),
        others=tuple((Estimate(Free("base_tilt.angle"), 0.1, 0.0, 0.2, "rad"),) for _ in verdict.alternatives),
        identifiability=learnt,
        before=(score("run_1", 0.4), score("run_2", np.inf)),
        after=(score("run_1", 0.1), score("run_2", 0.2)),
        closed=0.8,
        weakness="two recordings only",
        notes=("run_1: row 7 left out",),
        refitted=model,
        model=model,
    )


@pytest.mark.parametrize("kind", Kind)
def test_every_kind_for_machines(kind: Kind, tmp_path: Path) -> None:
    verdict = judged()[kind]
    write_json(found(verdict), tmp_path / "verdict.json")
    read = json.loads((tmp_path / "verdict.json").read_text(encoding="utf-8"))
    assert read == as_mapping(found(verdict))
    assert read["verdict"] == kind.value
    named, empty = ("helps", "causes") if kind is Kind.UNKNOWN else ("causes", "helps")
    assert [one["effect"] for one in read[named]] == [c.addition.effect for c in verdict.causes]
    assert read[empty] == []
    assert [one["effect"] for one in read["alternatives"]] == [c.addition.effect for c in verdict.alternatives]
    for one in (*read[named], *read["alternatives"]):
        assert 0 <= one["confidence"] <= 1
        assert set(one["parameters"]) == set(effect_named(one["effect"]).parameters)
        for entry in one["parameters"].values():
            assert entry["low"] <= entry["value"] <= entry["high"]
    assert read["nrmse_position"] == {"run_1": {"before": 0.4, "after": 0.1}, "run_2": {"before": None, "after": 0.2}}
    assert read["nrmse_velocity"]["run_1"] == {"before": 0.8, "after": 0.2}
    assert (read["weakness"], read["notes"]) == ("two recordings only", ["run_1: row 7 left out"])


@pytest.mark.parametrize(("joints", "joint"), [((2,), 3), ((0, 3), None), (None, None)])
def test_joints_for_machines_count_from_one(joints: tuple[int, ...] | None, joint: int | None) -> None:
    verdict = judge(BAD, [a_round(BAD, trial(Addition("rest_angle", joints), seed=5))])
    (cause,) = as_mapping(found(verdict))["causes"]
    assert cause["joint"] == joint
    assert cause["joints"] == (None if joints is None else [j + 1 for j in joints])


def test_a_file_that_cannot_be_written(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="cannot be written"):
        write_json(found(judged()[Kind.CAUSE]), tmp_path)


def test_the_part_of_the_gap_that_is_closed() -> None:
    def runs(*positions: float) -> list[RunScore]:
        return [score(f"run_{i}", position) for i, position in enumerate(positions)]

    assert closed_gap(runs(0.45, 0.25), runs(0.05, 0.05)) == pytest.approx(1.0)
    assert closed_gap(runs(0.45, 0.25), runs(0.25, 0.15)) == pytest.approx(0.5)
    assert closed_gap(runs(0.45), runs(0.45)) == 0.0
    assert closed_gap(runs(0.25), runs(0.45)) == pytest.approx(-1.0)
    assert closed_gap(runs(0.05), runs(0.05)) == 0.0  # nothing to close
    assert closed_gap(runs(np.inf, 0.25), runs(0.3, 0.25)) == pytest.approx(1 / 1.2)  # one could not be simulated
    assert closed_gap(runs(0.06, 0.45), runs(0.12, 0.05)) > 0.9  # next to the floor a run has no say
    assert closed_gap(runs(np.inf), runs(np.inf)) == 0.0
    assert closed_gap(runs(0.25), runs(np.inf)) == -1.0


def test_a_cause_whose_model_predicts_no_held_out_run_is_not_named() -> None:
    for kind, verdict in judged().items():
        named = kind in (Kind.CAUSE, Kind.AMBIGUOUS)
        if kind is Kind.ADEQUATE:
            continue
        assert confirmed(verdict, scores(0.45, 0.45), scores(0.05, 0.25)) is verdict
        assert confirmed(verdict, scores(0.05, 0.04), scores(0.05, 0.05)) is verdict  # nothing to predict better
        doubted = confirmed(verdict, scores(0.45, 0.45), scores(0.44, 0.40))
        assert doubted.kind is (Kind.UNKNOWN if named else kind)
        assert not (named and doubted.alternatives)
        assert ("does not predict runs" in verdict_in_words(doubted)) == named
    needless = judge(GOOD, [a_round(GOOD, trial("base_tilt", misfit=0.6, seed=3))])
    assert needless.kind is Kind.CAUSE
    assert confirmed(needless, scores(0.14), scores(0.13)).kind is Kind.ADEQUATE
    assert confirmed(needless, scores(0.45), scores(0.44)).kind is Kind.UNKNOWN


def test_no_model_is_adequate_whose_free_runs_end_far_from_what_was_measured() -> None:
    verdict = judged()[Kind.ADEQUATE]
    for near in (scores(0.05, 0.05), scores(0.09, 0.24)):
        assert confirmed(verdict, near, near) is verdict
    for far in (scores(0.05, 0.36), scores(0.05, np.inf)):
        doubted = confirmed(verdict, far, far)
        assert doubted.kind is Kind.UNKNOWN
        assert "does not predict whole runs" in verdict_in_words(doubted)


def test_more_has_to_be_explained_to_name_a_cause_than_to_call_a_model_adequate() -> None:
    assert is_adequate(trial(bad=0.05))
    assert not explains_all(trial(bad=0.05))
    assert explains_all(trial(bad=0.03))
    assert judge(BAD, [a_round(BAD, trial("base_tilt", bad=0.05))]).kind is Kind.UNKNOWN


def test_the_trials_here_are_of_the_size_that_is_meant() -> None:
    assert GOOD.relative.size == RUNS * WINDOWS
    assert np.mean(GOOD.relative) == pytest.approx(1.0, abs=0.05)

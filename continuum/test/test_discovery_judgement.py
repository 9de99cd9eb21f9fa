"""From evidence to a verdict, on trials made by hand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from discovery_laws import RUNS, SIZE, WINDOWS, a_round, trial
from discovery_verdicts import BAD, GOOD, HALF, PAYLOAD, WORSE, judged
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.candidate import Addition
from continuum.discovery.evidence import explains_all, gain, is_adequate, unexplained
from continuum.discovery.judgement import judge
from continuum.discovery.trial import Trial
from continuum.discovery.verdict import Kind
from continuum.dynamics.effect_lookup import effect_named


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


def later(trial_: Trial, leads: Sequence[Sequence[float]]) -> Trial:
    """What is worse by so much log-likelihood in each stretch of the runs, and whose fit is worse than its price."""
    runs = tuple(run.copy() for run in trial_.held_out[: len(leads)])
    for run, each in zip(runs, leads, strict=True):
        run[: 4 * len(each) : 4] += 2 * np.array(each)
    return replace(trial_, held_out=runs, sizes=trial_.sizes[: len(leads)], cost=trial_.cost + 100)


FAR, NEAR, NEAREST = (109.0, 0, 0, 0), (9.0, 0, 0, 0), (7.0, 0, 0, 0)
LOUD = (60.0, -60, 60, -51)


@pytest.mark.parametrize(("leads", "is_told"), [
    ((FAR, NEAR, NEAR, NEAR), True), ((FAR, NEAR, NEAR, NEAREST), False), ((FAR, NEAR, NEAR), True),
    ((FAR, (16.0, 0, 0, 0)), False), ((LOUD,) * 4, False), ((FAR, NEAR, NEAR, (20.0, -5, 0, 0)), False),
])  # fmt: skip
def test_what_acts_in_one_stretch_of_every_run_is_no_chance_where_each_of_several_tells_it(
    leads: Sequence[Sequence[float]], is_told: bool
) -> None:
    """Most of it in one run, a load that rubs at the first swing from the farthest bend: few stretches make it."""
    before = later(GOOD, leads)
    gained = gain(replace(GOOD, held_out=GOOD.held_out[: len(leads)], sizes=GOOD.sizes[: len(leads)]), before)
    assert gained.rest > 15
    assert 0 < gained.log_likelihood < 1.5 * gained.deviation
    assert gained.is_significant is is_told


def test_adequate_is_what_leaves_noise_but_for_a_few_windows() -> None:
    assert unexplained(BAD) == pytest.approx(0.3)
    assert is_adequate(GOOD)
    assert is_adequate(trial(bad=0.03))
    assert not is_adequate(trial(bad=0.08))


def test_a_model_that_is_bad_in_one_run_alone_is_not_adequate() -> None:
    """The motion that shows what is missing may be in no other run."""
    few = 4
    spread, gathered = trial(), trial()
    for run in spread.held_out[:few]:
        run[0] = 5 * SIZE
    gathered.held_out[1][:few] = 5 * SIZE
    assert unexplained(spread) == unexplained(gathered) == few / (RUNS * WINDOWS)
    assert is_adequate(spread)
    assert not is_adequate(gathered)


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


def test_a_model_that_is_a_little_wrong_everywhere_is_wrong() -> None:
    """No window by itself shows it."""
    loud = trial(misfit=1.6)
    assert unexplained(loud) == 0
    assert not is_adequate(loud)
    assert not explains_all(loud)
    assert judge(loud, []).kind is Kind.UNKNOWN
    assert is_adequate(trial(misfit=1.2))


def test_a_rival_that_just_fails_to_help_for_sure_is_one() -> None:
    """Two that explain the same are as likely, whichever of them the bar for chance falls between."""
    best, rival = (trial(name, misfit=misfit, seed=9) for name, misfit in (("rest_angle", 0.9), ("base_tilt", 0.9005)))
    bar = replace(GOOD, cost=rival.cost)  # the fits say that only the best one is worth its price
    verdict = judge(bar, [a_round(bar, best, rival)])
    assert gain(best, bar).is_significant
    assert not gain(rival, bar).is_significant
    assert [cause.addition.effect for cause in (*verdict.causes, *verdict.alternatives)] == ["rest_angle", "base_tilt"]
    assert verdict.kind is Kind.AMBIGUOUS


EVEN, UNEVEN = (0.6, 0.6, 0.6, 0.6), (1.2, 1.2, 0.0, 0.0)
"""Misfit of a rival's windows beyond the best one's, in units of noise: all explained, and half of them not."""


@pytest.mark.parametrize(("stretches", "more", "kind"), [
    (2, EVEN, Kind.AMBIGUOUS), (3, EVEN, Kind.AMBIGUOUS), (3, UNEVEN, Kind.CAUSE), (6, EVEN, Kind.CAUSE),
])  # fmt: skip
def test_what_would_do_by_itself_is_told_apart_only_by_a_sure_lead(
    stretches: int, more: tuple[float, ...], kind: Kind
) -> None:
    """A lead of 48 in each of some stretches, which is a few deviations: about the root of their number."""
    rival = replace(trial("base_tilt", seed=1), held_out=tuple(run.copy() for run in PAYLOAD.held_out))
    for number in range(stretches):
        first = 4 if number < RUNS else 12
        rival.held_out[number % RUNS][first : first + 4] += SIZE * np.array(more)
    lead = gain(PAYLOAD, rival)
    assert lead.rest > 15
    assert lead.log_likelihood / lead.deviation == pytest.approx(np.sqrt(stretches), rel=0.15)
    assert judge(BAD, [a_round(BAD, PAYLOAD, rival)]).kind is kind


def test_causes_that_cannot_be_told_apart_share_the_confidence() -> None:
    verdict = judged()[Kind.AMBIGUOUS]
    named = [*verdict.causes, *verdict.alternatives]
    assert [str(cause.addition) for cause in named] == ["tip_payload", "base_tilt"]
    assert named[0].confidence == pytest.approx(named[1].confidence) == pytest.approx(0.5, abs=0.02)
    for cause in named:
        effect = cause.addition.effect
        assert f"{effect}: {effect_named(effect).experiment}" in verdict.experiment


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


def test_more_has_to_be_explained_to_name_a_cause_than_to_call_a_model_adequate() -> None:
    assert is_adequate(trial(bad=0.05))
    assert not explains_all(trial(bad=0.05))
    assert explains_all(trial(bad=0.03))
    assert judge(BAD, [a_round(BAD, trial("base_tilt", bad=0.05))]).kind is Kind.UNKNOWN


def test_the_trials_here_are_of_the_size_that_is_meant() -> None:
    assert GOOD.relative.size == RUNS * WINDOWS
    assert np.mean(GOOD.relative) == pytest.approx(1.0, abs=0.05)

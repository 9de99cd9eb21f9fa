"""The decision on constructed candidates: what open-loop errors allow to be said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.candidate import Candidate, Key
from continuum.discovery.decision import (
    ALIKE,
    CHANCE,
    LEAST_SHARE,
    Kind,
    Verdict,
    closed,
    decide,
    is_farther,
    is_probable,
)

FLOOR, SEGMENTS, OBSERVATIONS = 0.003, 16, 80.0
NOISE = np.full(SEGMENTS, FLOOR)
SPRING: Key = (("joint_stiffness", (1,)),)
DRAG: Key = (("quadratic_drag", None),)
BOTH: Key = SPRING + DRAG
NONE: Key = ()


def candidate(effects: Key, error: float, scatter: float = 0.03) -> Candidate:
    """With open-loop errors of sixteen segments that differ by a few percent."""
    phases = 3.0 * np.arange(SEGMENTS) + len(effects)
    return Candidate(effects, error * (1 + scatter * np.cos(phases)), OBSERVATIONS)


def verdict(*others: Candidate, before: float = 0.03, tolerance: float = 0.009) -> Verdict:
    return decide(candidate(NONE, before), others, FLOOR, tolerance, 1.2 * before)


def test_a_model_that_misses_nothing_is_adequate() -> None:
    found = verdict(candidate(SPRING, 0.0031), before=0.0031)
    assert (found.kind, found.complete) == (Kind.ADEQUATE, True)


def test_what_is_not_missed_in_use_is_adequate_and_incomplete() -> None:
    """Something helps, not enough for a cause, and a user does not mind."""
    found = verdict(candidate(SPRING, 0.02), tolerance=0.04)
    assert (found.kind, found.complete) == (Kind.ADEQUATE, False)


def test_what_errs_by_less_than_the_sensors_has_no_cause() -> None:
    """An effect may close all of the distance to what it leaves: that is no distance to the noise."""
    baseline, other = (candidate(key, error) for key, error in ((NONE, 0.9 * FLOOR), (SPRING, 0.5 * FLOOR)))
    sharp = [replace(one, observations=5000.0) for one in (baseline, other)]
    assert decide(sharp[0], sharp[1:], FLOOR, 3 * FLOOR, FLOOR).kind is Kind.ADEQUATE
    assert decide(sharp[0], sharp[1:], FLOOR / 2, 3 * FLOOR, FLOOR).kind is Kind.CAUSE
    assert decide(sharp[0], sharp[1:], FLOOR, 3 * FLOOR, 4 * FLOOR).kind is Kind.CAUSE  # whole recordings run away


def test_a_tolerance_that_is_asked_for_makes_a_model_adequate() -> None:
    sets = candidate(NONE, 0.03), [candidate(SPRING, 0.0031)]
    assert decide(*sets, FLOOR, 0.05, 0.04).kind is Kind.CAUSE
    assert decide(*sets, FLOOR, 0.05, 0.04, True).kind is Kind.ADEQUATE
    assert decide(*sets, FLOOR, 0.05, 0.06, True).kind is Kind.CAUSE


def test_a_cause_that_leaves_something_says_so() -> None:
    found = verdict(candidate(SPRING, 0.01))
    assert (found.kind, found.complete) == (Kind.CAUSE, False)


def test_what_closes_alike_is_ambiguous() -> None:
    found = verdict(candidate(SPRING, 0.005), candidate(DRAG, 0.0051))
    assert found.kind is Kind.AMBIGUOUS
    assert set(found.sets) == {SPRING, DRAG}
    np.testing.assert_allclose(sum(found.relative_fits), 1.0)


def test_what_is_off_by_much_more_is_excluded() -> None:
    worse = 0.005 * (0.03 / 0.005) ** (3 * ALIKE)
    assert verdict(candidate(SPRING, 0.005), candidate(DRAG, worse)).sets == (SPRING,)


def test_a_second_effect_that_closes_much_is_named() -> None:
    found = verdict(candidate(SPRING, 0.012), candidate(BOTH, 0.004))
    assert (found.kind, found.sets) == (Kind.CAUSE, (BOTH,))


def test_what_helps_one_segment_alone_is_no_cause() -> None:
    """However much the mean falls by it."""
    before = candidate(NONE, 0.0031)
    errors = before.errors.copy()
    errors[3] = 0.5
    found = decide(
        Candidate(NONE, errors, OBSERVATIONS), [Candidate(SPRING, before.errors, OBSERVATIONS)], FLOOR, 0.0, 1.0
    )
    assert found.kind is Kind.UNKNOWN


@given(st.floats(0.0, 1.0))
def test_a_cause_closes_most(share: float) -> None:
    found = verdict(candidate(SPRING, 0.03 - share * (0.03 - FLOOR)))
    if share < LEAST_SHARE:
        assert found.kind is Kind.UNKNOWN
    if share > LEAST_SHARE + 0.1:
        assert (found.kind, found.sets) == (Kind.CAUSE, (SPRING,))


def test_what_helps_most_is_said_where_the_cause_is_unknown() -> None:
    found = verdict(candidate(SPRING, 0.02), candidate(DRAG, 0.024))
    assert (found.kind, found.sets, found.helps) == (Kind.UNKNOWN, (), SPRING)


@given(st.permutations([SPRING, DRAG, BOTH]), st.lists(st.floats(0.003, 0.03), min_size=3, max_size=3))
def test_the_order_of_candidates_does_not_matter(order: list[Key], errors: list[float]) -> None:
    error = dict(zip([SPRING, DRAG, BOTH], errors, strict=True))

    def found(keys: list[Key]) -> Verdict:
        return verdict(*(candidate(k, error[k]) for k in keys))

    assert found(order) == found([SPRING, DRAG, BOTH])


@given(st.floats(0.001, 0.05), st.floats(0.004, 0.05), st.floats(1.0, 100.0))
def test_a_verdict_has_no_unit(after: float, before: float, scale: float) -> None:
    def said(factor: float) -> tuple[Verdict, tuple[float, float, float]]:
        one, two = candidate(NONE, factor * before), candidate(SPRING, factor * after)
        return decide(one, [two], factor * FLOOR, factor * 0.009, factor * before), closed(one, two, factor * NOISE)

    (found, share), (scaled, scaled_share) = said(1.0), said(scale)
    assert (found.kind, found.sets, found.complete) == (scaled.kind, scaled.sets, scaled.complete)
    np.testing.assert_allclose(scaled_share, share, rtol=1e-9, atol=1e-12)
    value, low, high = share
    assert low - 1e-12 <= value <= high + 1e-12


def test_what_cannot_be_simulated_closes_nothing() -> None:
    failed = Candidate(SPRING, np.full(SEGMENTS, np.nan), OBSERVATIONS)
    assert closed(candidate(NONE, 0.03), failed, NOISE)[0] < 0
    assert verdict(failed).kind is Kind.UNKNOWN


def test_errors_that_fall_by_chance_are_no_lower() -> None:
    """Under the null, one in twenty is."""
    random, n, found = np.random.default_rng(0), 2000, 0
    for _ in range(n):
        one, two = (Candidate(NONE, 0.01 * np.exp(0.2 * random.standard_normal(8)), OBSERVATIONS) for _ in range(2))
        found += is_farther(one, two, 0.0)
    assert abs(found / n - 0.05) < 4 * np.sqrt(0.05 * 0.95 / n)


def test_of_nested_sets_that_are_alike_the_smaller_is_named() -> None:
    """One joint's sensor, and all joints' sensors, that joint's among them."""
    at_all: Key = (("angle_offset", None),)
    one, weak = (replace(candidate(SPRING, error), values=frozenset({1})) for error in (0.0031, 0.006))
    other, nested = (replace(candidate(at_all, 0.00309), values=frozenset(those)) for those in ({0, 2}, {0, 1, 2}))
    assert verdict(one, other).kind is Kind.AMBIGUOUS
    assert verdict(one, nested).kind is Kind.CAUSE
    assert verdict(one, nested).sets == (SPRING,)
    assert verdict(replace(one, errors=3 * one.errors), nested).sets == (at_all,)
    assert verdict(weak, nested).sets == (at_all,)
    assert verdict(weak, replace(nested, occam=1000.0)).sets == (SPRING,)  # what it gains on its part does not pay


def test_values_of_each_recording_are_not_worth_it_where_they_are_nothing() -> None:
    """Forty of noise, each fitted to a hundred rows: they lower the error by chance, and pay for it."""
    random, values, rows, prior = np.random.default_rng(0), 40, 100, 1.0
    sd = 1 / np.sqrt(1 / prior**2 + rows)
    named = dict.fromkeys((0.0, values * float(np.log(prior / sd))), 0)
    for _ in range(100):
        noise = random.standard_normal((values, rows))
        fitted = noise - rows * sd**2 * noise.mean(axis=1, keepdims=True)
        before, after = (np.full(2, np.sqrt(np.mean(x**2))) for x in (noise, fitted))
        for occam in named:
            per_run = Candidate(SPRING, after, noise.size, occam)
            named[occam] += is_probable(per_run, Candidate(NONE, before, noise.size))
    unpaid, paid = named.values()
    assert paid == 0
    assert unpaid > 90


def test_sizes_that_segments_disagree_about_leave_something_unknown() -> None:
    for agreement, steady in ((CHANCE / 2, False), (2 * CHANCE, True)):
        found = verdict(replace(candidate(SPRING, 0.0031), agreement=agreement))
        assert (found.kind, found.complete, found.steady) == (Kind.CAUSE, steady, steady)

"""The decision on constructed candidates: what evidence, missing torque and open-loop errors allow to be said."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.candidate import Candidate, Key
from continuum.discovery.decision import NEGLIGIBLE, PRICE, Kind, Verdict, closed, decide

TORQUE, FLOOR, TOLERANCE = 0.2, 0.003, 0.009
SPRING: Key = (("joint_stiffness", (1,)),)
DRAG: Key = (("quadratic_drag", None),)
BOTH: Key = SPRING + DRAG
NONE: Key = ()


def candidate(effects: Key, evidence: float, sigma: float, error: float, free: float = -10.0) -> Candidate:
    """With open-loop errors of eight runs that differ by a tenth."""
    errors = error * np.linspace(0.95, 1.05, 8)
    return Candidate(effects, evidence, sigma, errors, free)


def verdict(baseline: Candidate, *others: Candidate) -> Verdict:
    return decide(baseline, others, TORQUE, FLOOR, TOLERANCE)


LITTLE, MUCH = 0.5 * NEGLIGIBLE * TORQUE, 10 * NEGLIGIBLE * TORQUE


def test_a_model_that_misses_nothing_is_adequate() -> None:
    found = verdict(candidate(NONE, 0.0, LITTLE, 0.02), candidate(SPRING, PRICE, LITTLE, 0.02))
    assert found.kind is Kind.ADEQUATE
    assert found.complete


def test_one_effect_that_explains_all_is_the_cause() -> None:
    found = verdict(
        candidate(NONE, 0.0, MUCH, 0.03, 500.0),
        candidate(SPRING, 800.0, LITTLE, 0.005),
        candidate(DRAG, 300.0, MUCH, 0.02, 200.0),
    )
    assert (found.kind, found.sets, found.complete) == (Kind.CAUSE, (SPRING,), True)
    assert found.probabilities == (1.0,)


def test_what_fits_alike_is_ambiguous() -> None:
    found = verdict(
        candidate(NONE, 0.0, MUCH, 0.03), candidate(SPRING, 800.0, LITTLE, 0.005), candidate(DRAG, 799.0, LITTLE, 0.005)
    )
    assert found.kind is Kind.AMBIGUOUS
    assert found.sets[0] == SPRING
    assert set(found.sets) == {SPRING, DRAG}
    np.testing.assert_allclose(sum(found.probabilities), 1.0)


def test_a_second_effect_that_closes_nothing_is_not_named() -> None:
    one, two = candidate(SPRING, 800.0, LITTLE, 0.005), candidate(BOTH, 900.0, LITTLE, 0.005)
    found = verdict(candidate(NONE, 0.0, MUCH, 0.03), one, two)
    assert (found.kind, found.sets) == (Kind.CAUSE, (SPRING,))


def test_a_second_effect_that_closes_much_is_named() -> None:
    one, two = candidate(SPRING, 800.0, MUCH, 0.015), candidate(BOTH, 1200.0, LITTLE, 0.004)
    found = verdict(candidate(NONE, 0.0, MUCH, 0.03), one, two)
    assert (found.kind, found.sets) == (Kind.CAUSE, (BOTH,))


def test_what_a_part_simulates_better_is_no_cause() -> None:
    """More probable by far, and yet its simulations are worse than those of a part of it."""
    one, two = candidate(SPRING, 500.0, MUCH, 0.008), candidate(BOTH, 2000.0, LITTLE, 0.02)
    found = verdict(candidate(NONE, 0.0, MUCH, 0.03), one, two)
    assert BOTH not in found.sets


def test_nothing_that_helps_is_unknown_and_no_cause() -> None:
    found = verdict(candidate(NONE, 0.0, MUCH, 0.03, 900.0), candidate(SPRING, 300.0, MUCH, 0.028, 600.0))
    assert (found.kind, found.sets) == (Kind.UNKNOWN, ())
    assert found.helps == SPRING


def test_a_free_form_torque_that_finds_much_besides_forbids_a_cause() -> None:
    explained = candidate(SPRING, 800.0, MUCH, 0.008, 10.0)
    assert verdict(candidate(NONE, 0.0, MUCH, 0.03), explained).kind is Kind.CAUSE
    left = candidate(SPRING, 800.0, MUCH, 0.008, 400.0)
    assert verdict(candidate(NONE, 0.0, MUCH, 0.03), left).kind is Kind.UNKNOWN


def test_a_cause_that_leaves_something_says_so() -> None:
    found = verdict(candidate(NONE, 0.0, MUCH, 0.03), candidate(SPRING, 800.0, MUCH, 0.008, 10.0))
    assert found.kind is Kind.CAUSE
    assert not found.complete


def test_small_errors_are_adequate_whatever_is_missing() -> None:
    found = verdict(candidate(NONE, 0.0, MUCH, 0.9 * TOLERANCE, 50.0))
    assert found.kind is Kind.ADEQUATE
    assert not found.complete


@given(st.permutations([SPRING, DRAG, BOTH]), st.integers(0, 3))
def test_the_order_of_candidates_does_not_matter(order: list[Key], case: int) -> None:
    evidence = ({SPRING: 800.0, DRAG: 790.0, BOTH: 805.0}, {SPRING: 10.0, DRAG: 700.0, BOTH: 1500.0},
                {SPRING: 5.0, DRAG: 6.0, BOTH: 4.0}, {SPRING: 300.0, DRAG: 100.0, BOTH: 320.0})[case]  # fmt: skip
    errors = {SPRING: 0.006, DRAG: 0.007, BOTH: 0.005}

    def found(keys: list[Key]) -> Verdict:
        return verdict(candidate(NONE, 0.0, MUCH, 0.03), *(candidate(k, evidence[k], LITTLE, errors[k]) for k in keys))

    assert found(order) == found([SPRING, DRAG, BOTH])


@given(st.floats(0.001, 0.05), st.floats(0.004, 0.05), st.floats(1.0, 100.0))
def test_a_closed_share_has_no_unit(after: float, before: float, scale: float) -> None:
    def share(factor: float) -> tuple[float, float, float]:
        one, two = candidate(NONE, 0.0, MUCH, factor * before), candidate(SPRING, 0.0, MUCH, factor * after)
        return closed(one, two, factor * FLOOR)

    np.testing.assert_allclose(share(scale), share(1.0), rtol=1e-9, atol=1e-12)
    value, low, high = share(1.0)
    assert low - 1e-12 <= value <= high + 1e-12
    np.testing.assert_allclose(value, (before - after) / (before - FLOOR) if before > FLOOR else 0.0, rtol=0.2)


def test_what_cannot_be_simulated_closes_nothing() -> None:
    one = candidate(NONE, 0.0, MUCH, 0.03)
    two = Candidate(SPRING, 900.0, MUCH, np.full(8, np.nan), 0.0)
    assert closed(one, two, FLOOR)[0] < 0
    assert verdict(one, two).kind is Kind.UNKNOWN


def test_missing_torque_leaves_a_cause_incomplete() -> None:
    """Though no torque of free form finds anything besides."""
    found = verdict(candidate(NONE, 0.0, MUCH, 0.03), candidate(SPRING, 800.0, MUCH, 0.008))
    assert (found.kind, found.sets, found.complete) == (Kind.CAUSE, (SPRING,), False)

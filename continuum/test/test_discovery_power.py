"""Power: larger changes are named more often, at the size that is stated in four of five draws."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.power import POWER, Power

NOTHING = Hypothesis("some", None, (), (), np.zeros(0), np.zeros(0))
CHANGES = st.lists(st.floats(1e-3, 30.0), min_size=4, max_size=16)


def power(left: list[float], bounded: float, values: int, observations: float = 3000.0) -> Power:
    """Of an effect of which a refit takes a part at typical sizes, and another at larger ones."""
    both = np.array([left, bounded * np.array(left)])
    noise = np.full(len(left), 1e-3)
    return Power(NOTHING, 1.0, (1.0, 4.0), both, noise, 0.95e-3, observations, values)


@given(CHANGES, st.floats(0.01, 3.0), st.integers(0, 40))
def test_from_the_stated_size_on_it_is_named(left: list[float], bounded: float, values: int) -> None:
    one = power(left, bounded, values)
    if np.isfinite(one.smallest):
        for times in (1.0, 1.5, 3.0, 10.0):
            assert one.probability(times * one.smallest) >= POWER - 0.1


@given(CHANGES, st.floats(0.01, 3.0), st.floats(0.1, 10.0), st.floats(1.0, 10.0))
def test_a_larger_size_is_named_as_often(left: list[float], bounded: float, size: float, times: float) -> None:
    """But for chance: a small change may lower an error as well as raise it."""
    one = power(left, bounded, 0)
    assert one.probability(times * size) >= one.probability(size) - 0.1


def test_what_acts_in_one_segment_alone_is_no_cause() -> None:
    """However much it does there: most of the error has to be closed whatever segment is left out."""
    assert power([30.0, *[0.0] * 15], 1.0, 0).smallest == np.inf


@given(CHANGES, st.integers(0, 8))
def test_what_changes_more_is_seen_earlier(left: list[float], values: int) -> None:
    assert power([3 * x for x in left], 1.0, values).smallest <= power(left, 1.0, values).smallest


def test_nothing_is_named_that_changes_nothing() -> None:
    one = power([0.0] * 8, 1.0, 0)
    assert one.smallest == np.inf
    assert one.kept == 0.0

"""What unknowns cost, and how many errors tell something of their own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from discovery_laws import RUNS, SIZE, WINDOWS, trial
from scipy.signal import lfilter

from continuum.discovery.evidence import gain
from continuum.discovery.information import effective_number, information_gain
from continuum.discovery.trial import Trial
from continuum.identification.free import Free

ERRORS = RUNS * WINDOWS * SIZE
GOOD, BAD = trial("quadratic_drag", seed=1), trial(bad=0.3, seed=2)


def with_unknowns(one: Trial, count: int) -> Trial:
    return replace(
        one, unknowns=tuple(Free("angle_offset.offset", j, run) for run in range(count // 5) for j in range(5))
    )


def scattered(likeness: float, windows: int = 2000) -> Trial:
    """Misfits of neighbouring windows alike by a first-order process."""
    random = np.random.default_rng(4)
    runs = [lfilter([np.sqrt(1 - likeness**2)], [1.0, -likeness], random.normal(size=windows)) for _ in range(RUNS)]
    return replace(GOOD, held_out=tuple(SIZE * (1 + 0.1 * run) for run in runs), sizes=(np.full(windows, SIZE),) * RUNS)


def test_without_more_unknowns_it_is_what_the_fit_gains() -> None:
    assert information_gain(GOOD, BAD) == pytest.approx(BAD.cost - GOOD.cost)
    assert information_gain(GOOD, BAD) == -information_gain(BAD, GOOD)


@pytest.mark.parametrize("count", [5, 20])
def test_every_unknown_costs_half_the_logarithm_of_the_errors(count: int) -> None:
    price = information_gain(GOOD, BAD) - information_gain(with_unknowns(GOOD, count), BAD)
    assert price == pytest.approx(count / 2 * np.log(effective_number(GOOD)))
    assert price == pytest.approx(count / 2 * np.log(ERRORS), rel=0.05)


@pytest.mark.parametrize("likeness", [0.0, 0.3, 0.6, 0.9])
def test_errors_that_hang_together_count_less(likeness: float) -> None:
    one = scattered(likeness)
    expected = (1 - likeness) / (1 + likeness) * RUNS * 2000 * SIZE
    assert effective_number(one) == pytest.approx(expected, rel=0.15)


def test_windows_without_scatter_count_as_independent() -> None:
    alike = replace(GOOD, held_out=tuple(np.full(WINDOWS, SIZE) for _ in range(RUNS)))
    assert effective_number(alike) == ERRORS


def test_a_gain_that_its_unknowns_cost_is_not_significant() -> None:
    little = replace(GOOD, held_out=tuple(0.95 * run for run in BAD.held_out), cost=BAD.cost - 30.0)
    assert gain(little, BAD).is_significant
    assert not gain(with_unknowns(little, 20), BAD).is_significant

"""Inputs amid the substeps: means of a signal over each, whenever it begins; the noise of readings at rest."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from continuum_laws.strategies import LAW
from hypothesis import given
from hypothesis import strategies as st

from continuum.dynamics.tensions import Tensions
from continuum.estimation.run import Run
from continuum.estimation.sensor_noise import white_noise

SEEDS = st.integers(0, 10**6)
DELAYS = st.floats(-0.05, 0.3)


def drawn(seed: int, held: bool, breaks: int = 9) -> Run:
    """Rows and inputs at times of their own; rows reach beyond both ends of the inputs."""
    random = np.random.default_rng(seed)
    times = random.uniform(-0.1, 0.1) + np.cumsum(random.uniform(0.001, 0.03, 12))
    given_at = random.uniform(-0.1, 0.2) + np.cumsum(random.uniform(0.002, 0.03, breaks))
    readings = np.zeros((12, 1))
    return Run("any", times, readings, readings, 1, (given_at, random.uniform(0, 5, (breaks, 2))), held)


def edges(run: Run) -> np.ndarray:
    """Where the substeps begin, and the last one ends."""
    return run.times[0] + np.concatenate([[0.0], np.cumsum(run.length)])


@LAW
@given(SEEDS, DELAYS, st.booleans())
def test_inputs_are_means_over_the_substeps(seed: int, delay: float, held: bool) -> None:
    """Of the simulator's inputs, summed over many instants between the breaks."""
    run = drawn(seed, held)
    output, ends = Tensions(run.signal[0] + delay, run.signal[1], held), edges(run)
    found = run.inputs_later(delay)
    for k, (begin, end) in enumerate(pairwise(ends)):
        inside = output.times[(output.times > begin) & (output.times < end)]
        pieces = np.concatenate([[begin], inside, [end]])
        total = np.zeros(2)
        for a, b in pairwise(pieces):
            moments = a + (b - a) * (np.arange(20) + 0.5) / 20  # the middles of parts: exact for a straight line
            total += (b - a) * output.over(moments).mean(axis=0)
        np.testing.assert_allclose(found[k], total / (end - begin), rtol=1e-7, atol=1e-7)


@LAW
@given(SEEDS, DELAYS, DELAYS, st.booleans())
def test_later_inputs_are_those_of_a_signal_that_begins_later(
    seed: int, delay: float, further: float, held: bool
) -> None:
    """By parts or at once."""
    run = drawn(seed, held)
    late = replace(run, signal=(run.signal[0] + delay, run.signal[1]))
    np.testing.assert_allclose(run.inputs_later(delay), late.inputs, rtol=1e-7, atol=1e-7)
    np.testing.assert_allclose(run.inputs_later(delay + further), late.inputs_later(further), rtol=1e-7, atol=1e-7)
    np.testing.assert_array_equal(run.inputs_later(0.0), run.inputs)


@LAW
@given(SEEDS, st.booleans())
def test_substeps_fill_the_intervals(seed: int, held: bool) -> None:
    """Each interval by equal ones."""
    run = drawn(seed, held)
    for k, (a, b) in enumerate(pairwise(run.first)):
        np.testing.assert_allclose(run.length[a:b], run.intervals[k] / (b - a), rtol=1e-12)
    np.testing.assert_allclose(edges(run)[run.first], run.times, rtol=0, atol=1e-12)


@pytest.mark.parametrize("shared", [0.0, 0.5])
def test_noise_at_rest_is_found(shared: float) -> None:
    """That of angles and of rates, also where neighbouring joints share a sensor."""
    random, rows, n, sizes = np.random.default_rng(3), 3000, 4, (2e-3, 8e-3)
    covariance = np.eye(n) - shared * (np.eye(n, k=1) + np.eye(n, k=-1))
    readings = np.hstack([random.multivariate_normal(np.zeros(n), size**2 * covariance, rows) for size in sizes])
    run = Run("rest", np.arange(rows) / 120, readings, np.ones_like(readings), n, (np.zeros(1), np.zeros((1, 2))))
    found = white_noise([run])
    for size, part in zip(sizes, (slice(n), slice(n, 2 * n)), strict=True):
        np.testing.assert_allclose(found[part, part] / size**2, covariance, rtol=0.1, atol=0.08)
    assert not np.any(found[:n, n:])

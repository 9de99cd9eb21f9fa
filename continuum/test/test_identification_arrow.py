"""Least squares of windows: linear problems, whose answers are known, however little the data tell along some way."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from continuum.arrays import Array
from continuum.identification.arrow_least_squares import Evaluate, FitStatus, Part, Unknowns, arrow_least_squares

_WIDE = 1e3


def _linear(by_shared: Array, by_own: Array, measured: Array) -> tuple[Evaluate, Unknowns]:
    """Windows with errors ``by_shared x + by_own z - measured``, (n_windows, m, ..)."""

    def evaluate(shared: Array, own: Sequence[Array], _anew: bool) -> tuple[list[Part], list[Array]]:
        parts = [
            Part(a @ shared + b @ mine - y, a, b)
            for a, b, mine, y in zip(by_shared, by_own, own, measured, strict=True)
        ]
        return parts, list(own)

    windows, _, k = by_shared.shape
    own = [np.zeros(by_own.shape[2])] * windows
    spreads = [np.full(by_own.shape[2], _WIDE)] * windows
    return evaluate, Unknowns(np.zeros(k), np.full(k, 1.0), np.full(k, -_WIDE), np.full(k, _WIDE), own, spreads)


def _answer(by_shared: Array, by_own: Array, measured: Array) -> Array:
    """The same by NumPy: all windows stacked, the priors as further rows."""
    windows, m, k = by_shared.shape
    j = by_own.shape[2]
    rows, right = [], []
    for i in range(windows):
        row = np.zeros((m, k + windows * j))
        row[:, :k], row[:, k + i * j : k + (i + 1) * j] = by_shared[i], by_own[i]
        rows.append(row)
        right.append(measured[i])
    prior = np.diag([1.0] * k + [1 / _WIDE] * (windows * j))
    stacked = np.vstack([*rows, prior])
    return np.linalg.lstsq(stacked, np.concatenate([*right, np.zeros(len(prior))]))[0][:k]


@pytest.mark.parametrize("to_the_end", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_linear_windows_are_solved(seed: int, to_the_end: bool) -> None:
    random = np.random.default_rng(seed)
    by_shared, by_own = random.normal(size=(4, 12, 3)), random.normal(size=(4, 12, 2))
    measured = 0.3 * random.normal(size=(4, 12)) + by_shared @ np.array([0.5, -0.2, 0.8])
    evaluate, unknowns = _linear(by_shared, by_own, measured)
    found = arrow_least_squares(evaluate, unknowns, 30, to_the_end=to_the_end)
    assert found.status is FitStatus.CONVERGED
    np.testing.assert_allclose(found.shared, _answer(by_shared, by_own, measured), atol=0.01)


def test_to_the_end_it_goes_where_the_data_tell_nothing() -> None:
    """The data tell the sum of two unknowns, and well: that the prior halves it lowers the cost by 1 of thousands."""
    random = np.random.default_rng(5)
    by_shared = 3.0 * np.repeat(random.normal(size=(20, 300, 1)), 2, axis=2)
    by_own = random.normal(size=(20, 300, 1))
    measured = random.normal(size=(20, 300)) + by_shared @ np.array([1.0, 1.0])
    evaluate, unknowns = _linear(by_shared, by_own, measured)
    begun = replace(unknowns, shared=np.array([1.95, 0.05]))
    early = arrow_least_squares(evaluate, begun, 12)
    late = arrow_least_squares(evaluate, begun, 12, to_the_end=True)
    assert abs(early.shared[0] - 1.0) > 0.5  # it is not worth its while
    np.testing.assert_allclose(late.shared, [1.0, 1.0], atol=0.05)
    assert late.cost < early.cost

"""Least squares with unknowns shared by all windows and unknowns of each: the normal matrix has the shape of an arrow.

Levenberg and Marquardt's method. Eliminating each window's own unknowns (Schur complement) leaves a system in the
shared ones, so that the cost grows with the number of windows only linearly. Every unknown has a prior, which keeps
the system regular where the data say nothing; the shared ones have bounds. Few windows in which nothing fits, where a
joint was about to slip and did not, shall not decide: beyond what noise explains a window's misfit counts by its
logarithm (Student's distribution, of few degrees of freedom).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array

_ENOUGH = 0.5  # of log-likelihood: a smaller expected gain is not worth a step
_ENOUGH_OF_COST = 5e-4
_ENOUGH_TO_THE_END = 0.01  # the same where the very values matter
_LEAST_DAMPING, _MOST_DAMPING = 1e-6, 1e4
_FIRST_DAMPING, _FIRST_TO_THE_END = 1e-3, 1e-5
_NEAR = 0.03  # of the cost: expected to gain less, the search seeks bad windows anew for the first time
_NOISE = 1.5  # squared errors, per error, up to which they may be noise
_TAIL = 1.0  # so far beyond, a window counts half
MOST_MISFIT = 12.0
"""Of a window in which nothing fits, per error."""
_STALLED, _LOOKED_BACK = 1e-2, 6  # share of the cost that so many iterations must gain


class FitStatus(Enum):
    """How a fit ended."""

    CONVERGED = "converged"
    NO_CONVERGENCE = "did not converge"
    NO_SIMULATION = "the model cannot be simulated where the fit starts"


@dataclass(frozen=True)
class Part:
    """One window at one point: errors (m,), and their slopes by shared (m, k) and own unknowns (m, j)."""

    errors: Array
    by_shared: Array
    by_own: Array


type Evaluate = Callable[[Array, Sequence[Array], bool], tuple[list[Part], list[Array]] | None]
"""All windows and their own unknowns, at given shared ones, the own ones sought from given ones on; None where a window
cannot be simulated. The last argument asks to seek bad windows anew."""


@dataclass(frozen=True)
class Unknowns:
    """Where the unknowns are, their prior (normal around 0) and bounds.

    Attributes:
        shared, spread, lower, upper: (k,).
        own, own_spread: one (j,) for each window; j may differ.
    """

    shared: Array
    spread: Array
    lower: Array
    upper: Array
    own: Sequence[Array]
    own_spread: Sequence[Array]


@dataclass(frozen=True)
class Solution:
    """Where the cost is least.

    Attributes:
        status: how the search ended.
        shared, own: the unknowns.
        parts: every window there.
        cost: minus the logarithm of likelihood and prior.
        evaluations: how often all windows were simulated.
        promised: by how much the cost would fall from there, were the errors linear.
    """

    status: FitStatus
    shared: Array
    own: Sequence[Array]
    parts: Sequence[Part]
    cost: float
    evaluations: int
    promised: float = 0.0


def arrow_least_squares(
    evaluate: Evaluate, unknowns: Unknowns, iterations: int, seekings: int = 2, to_the_end: bool = False
) -> Solution:
    """Search from where the unknowns are, with at most so many iterations.

    Damping holds the shared unknowns and the windows' own alike. Where the search settles,
    windows that are still bad are sought anew, at most ``seekings`` times, and it goes on if that helped.

    ``to_the_end`` it goes on where the cost hardly falls, and hardly damped: where little but the prior tells the
    values of all joints from those of each, these may still be standard deviations off.
    """
    shared = unknowns.shared
    begun = evaluate(shared, unknowns.own, False)
    if begun is None:
        return Solution(FitStatus.NO_SIMULATION, shared, unknowns.own, [], np.inf, 1)
    first_damping = _FIRST_TO_THE_END if to_the_end else _FIRST_DAMPING
    (parts, own), damping, evaluations, sought_before = begun, first_damping, 1, 0
    cost = _cost(unknowns, parts, shared, own)
    costs = [cost]
    for _ in range(iterations):
        step, own_steps, gain = _damped_step(unknowns, parts, shared, own, damping)
        enough = _ENOUGH_TO_THE_END if to_the_end else max(_ENOUGH, _ENOUGH_OF_COST * cost)
        near = sought_before == 0 < seekings and gain < _NEAR * cost
        settled = gain < enough or damping > _MOST_DAMPING or (_has_stalled(costs) and not to_the_end)
        if not settled and not near:
            there = np.clip(shared + step, unknowns.lower, unknowns.upper)
            tried = evaluate(there, [mine + change for mine, change in zip(own, own_steps, strict=True)], False)
            evaluations += 1
            new = np.inf if tried is None else _cost(unknowns, tried[0], there, tried[1])
            costs.append(min(new, cost))
            if tried is None or new >= cost:
                damping *= 10
                continue
            damping = max(damping * (0.1 if cost - new > 0.5 * gain else 0.5), _LEAST_DAMPING)
            settled = cost - new < enough
            shared, (parts, own), cost = there, tried, new
        if settled and sought_before == seekings:
            return Solution(FitStatus.CONVERGED, shared, own, parts, cost, evaluations)
        if settled or near:
            sought = evaluate(shared, own, True)
            evaluations, sought_before, damping = evaluations + 1, sought_before + 1, first_damping
            if sought is None or _cost(unknowns, sought[0], shared, sought[1]) > cost - enough:
                if settled:
                    return Solution(FitStatus.CONVERGED, shared, own, parts, cost, evaluations)
                continue
            parts, own = sought
            cost = _cost(unknowns, parts, shared, own)
            costs = [cost]
    promised = _damped_step(unknowns, parts, shared, own, _LEAST_DAMPING)[2]
    return Solution(FitStatus.NO_CONVERGENCE, shared, own, parts, cost, evaluations, promised)


def _has_stalled(costs: Sequence[float]) -> bool:
    return len(costs) > _LOOKED_BACK and costs[-1 - _LOOKED_BACK] - costs[-1] < _STALLED * costs[-1]


def misfit_of(part: Part) -> float:
    """Twice the negative log-likelihood of a window, but for a constant: its squared errors while those are noise."""
    return misfit(float(part.errors @ part.errors), part.errors.size)


def misfit(square: float, size: int) -> float:
    """The same by the sum of ``size`` squared errors."""
    return min(square, _NOISE * size) + size * _TAIL * float(np.log1p(_beyond(square, size) / _TAIL))


def weight_of(part: Part) -> float:
    """Weight of a window's squared errors, the slope of `misfit_of`: 1 where they are those of noise, less beyond."""
    return _TAIL / (_beyond(float(part.errors @ part.errors), part.errors.size) + _TAIL)


def _beyond(square: float, size: int) -> float:
    """Mean squared error beyond that of noise."""
    return max(square / size - _NOISE, 0.0)


def shared_information(unknowns: Unknowns, parts: Sequence[Part]) -> Array:
    """Fisher information of the shared unknowns with prior, each window's own unknowns eliminated, (k, k)."""
    matrix = np.diag(unknowns.spread**-2.0)
    for part, spread in zip(parts, unknowns.own_spread, strict=True):
        matrix = matrix + part.by_shared.T @ reduced(part, spread) * weight_of(part)
    return (matrix + matrix.T) / 2


def reduced(part: Part, own_spread: Array) -> Array:
    """Slopes of a window's errors by the shared unknowns, (m, k), less what its own unknowns can make good."""
    own = part.by_own.T @ part.by_own + np.diag(own_spread**-2.0)
    return part.by_shared - part.by_own @ np.linalg.solve(own, part.by_own.T @ part.by_shared)


def _cost(unknowns: Unknowns, parts: Sequence[Part], shared: Array, own: Sequence[Array]) -> float:
    priors = sum(float(np.sum((mine / spread) ** 2)) for mine, spread in zip(own, unknowns.own_spread, strict=True))
    return (sum(misfit_of(part) for part in parts) + priors + float(np.sum((shared / unknowns.spread) ** 2))) / 2


def _damped_step(
    unknowns: Unknowns, parts: Sequence[Part], shared: Array, own: Sequence[Array], damping: float
) -> tuple[Array, list[Array], float]:
    """Steps of shared and own unknowns, and the gain that the linear model expects of them."""
    gradient, matrix = shared / unknowns.spread**2, np.diag(unknowns.spread**-2.0)
    windows = []
    for part, mine, spread in zip(parts, own, unknowns.own_spread, strict=True):
        weight = weight_of(part)
        slopes = np.hstack([part.by_shared, part.by_own])
        square, pull, k = weight * slopes.T @ slopes, weight * slopes.T @ part.errors, shared.size
        gradient, matrix = gradient + pull[:k], matrix + square[:k, :k]
        windows.append((pull[k:] + mine / spread**2, square[:k, k:], square[k:, k:] + np.diag(spread**-2.0)))
    free = ~(((shared <= unknowns.lower) & (gradient > 0)) | ((shared >= unknowns.upper) & (gradient < 0)))
    schur, right = matrix + damping * np.diag(np.diag(matrix)), -gradient
    inner = []
    for g, coupling, square in windows:
        damped = square + damping * np.diag(np.diag(square))
        solved = np.linalg.solve(damped, np.column_stack([g, coupling.T]))
        inner.append((solved[:, 0], solved[:, 1:]))
        right, schur = right + coupling @ solved[:, 0], schur - coupling @ solved[:, 1:]
    step = _bounded_step(schur, right, free, unknowns.lower - shared, unknowns.upper - shared)
    own_steps = [-at_once - through @ step for at_once, through in inner]
    gain = -gradient @ step - step @ matrix @ step / 2
    for (g, coupling, square), change in zip(windows, own_steps, strict=True):
        gain -= g @ change + change @ square @ change / 2 + step @ coupling @ change
    return step, own_steps, float(gain)


def _bounded_step(matrix: Array, right: Array, free: NDArray[np.bool_], lower: Array, upper: Array) -> Array:
    """Solution of ``matrix step = right`` in the free coordinates; those that reach a bound stay there."""
    step, free = np.zeros(right.size), free.copy()
    while np.any(free):
        held = right[free] - matrix[np.ix_(free, ~free)] @ step[~free]
        step[free] = np.linalg.solve(matrix[np.ix_(free, free)], held)
        beyond = (step < lower) | (step > upper)
        step = np.clip(step, lower, upper)
        if not np.any(beyond):
            break
        free &= ~beyond
    return step

"""Least squares with unknowns shared by all runs and unknowns of each: the normal matrix has the shape of an arrow.

Levenberg and Marquardt's method. Eliminating each run's own unknowns (Schur complement) leaves a system in the shared
ones, so that the cost grows with the number of runs only linearly. Every unknown has a prior, which keeps the system
regular where the data say nothing, and the shared ones have bounds.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from continuum.arrays import Array

_ENOUGH = 0.02  # of log-likelihood: a smaller expected gain is not worth a step
_MOST_ITERATIONS = 40


class FitStatus(Enum):
    """How a fit ended."""

    CONVERGED = "converged"
    NO_CONVERGENCE = "did not converge"
    NO_SIMULATION = "the model cannot be simulated where the fit starts"


@dataclass(frozen=True)
class RunPart:
    """One run at one point: errors (m,), and their slopes by shared (m, k) and own unknowns (m, j)."""

    errors: Array
    by_shared: Array
    by_own: Array


type Evaluate = Callable[[Array, Sequence[Array]], list[RunPart] | None]
"""All runs at given shared and own unknowns; None where they cannot be simulated."""


@dataclass(frozen=True)
class Unknowns:
    """Start, prior (normal around 0 in the shared, around the start in the own ones) and bounds.

    Attributes:
        shared, shared_spread, lower, upper: (k,).
        own, own_spread: one (j,) for each run.
    """

    shared: Array
    shared_spread: Array
    lower: Array
    upper: Array
    own: Sequence[Array]
    own_spread: Sequence[Array]

    def cost(self, parts: Sequence[RunPart], shared: Array, own: Sequence[Array]) -> float:
        """Half the sum of squares: minus the logarithm of likelihood and prior."""
        total = float(np.sum((shared / self.shared_spread) ** 2))
        for part, mine, start, spread in zip(parts, own, self.own, self.own_spread, strict=True):
            total += float(part.errors @ part.errors) + float(np.sum(((mine - start) / spread) ** 2))
        return total / 2


@dataclass(frozen=True)
class Solution:
    """Where the cost is least.

    Attributes:
        status: how the search ended.
        shared, own: the unknowns.
        parts: every run there.
        cost: see `Unknowns.cost`.
        evaluations: how often all runs were simulated.
    """

    status: FitStatus
    shared: Array
    own: Sequence[Array]
    parts: Sequence[RunPart]
    cost: float
    evaluations: int


def arrow_least_squares(evaluate: Evaluate, unknowns: Unknowns, own_start: Sequence[Array] | None = None) -> Solution:
    """Search from the start of the unknowns, or of the own ones from elsewhere."""
    shared, own = unknowns.shared, list(unknowns.own if own_start is None else own_start)
    parts = evaluate(shared, own)
    if parts is None:
        return Solution(FitStatus.NO_SIMULATION, shared, own, [], np.inf, 1)
    cost, damping, evaluations = unknowns.cost(parts, shared, own), 1e-2, 1
    for _ in range(_MOST_ITERATIONS):
        step, own_steps, gain = damped_step(unknowns, parts, shared, own, damping)
        if gain < _ENOUGH and damping <= 1.0:
            return Solution(FitStatus.CONVERGED, shared, own, parts, cost, evaluations)
        there = np.clip(shared + step, unknowns.lower, unknowns.upper)
        own_there = [mine + change for mine, change in zip(own, own_steps, strict=True)]
        tried, evaluations = evaluate(there, own_there), evaluations + 1
        new = np.inf if tried is None else unknowns.cost(tried, there, own_there)
        if tried is not None and new < cost:
            good = (cost - new) > 0.5 * gain
            settled = cost - new < _ENOUGH and gain < 20 * _ENOUGH
            shared, own, parts, cost = there, own_there, tried, new
            damping = damping * (0.1 if good else 0.5)
            if settled:
                return Solution(FitStatus.CONVERGED, shared, own, parts, cost, evaluations)
        else:
            damping *= 8
            if damping > 1e6:  # no way down is left: noise of the integration decides
                return Solution(FitStatus.CONVERGED, shared, own, parts, cost, evaluations)
    return Solution(FitStatus.NO_CONVERGENCE, shared, own, parts, cost, evaluations)


def damped_step(
    unknowns: Unknowns, parts: Sequence[RunPart], shared: Array, own: Sequence[Array], damping: float
) -> tuple[Array, list[Array], float]:
    """Steps of shared and own unknowns, and the gain that the linear model expects of them."""
    gradient, matrix, runs = _normal_equations(unknowns, parts, shared, own)
    free = ~(((shared <= unknowns.lower) & (gradient > 0)) | ((shared >= unknowns.upper) & (gradient < 0)))
    schur, right = matrix + damping * np.diag(np.diag(matrix)), -gradient
    inner = []
    for g, B, C in runs:
        solved = np.linalg.solve(C + damping * np.diag(np.diag(C)), np.column_stack([g, B.T]))
        inner.append((solved[:, 0], solved[:, 1:]))
        right = right + B @ solved[:, 0]
        schur = schur - B @ solved[:, 1:]
    step = np.zeros(shared.size)
    if np.any(free):
        step[free] = np.linalg.solve(schur[np.ix_(free, free)], right[free])
    step = np.clip(shared + step, unknowns.lower, unknowns.upper) - shared
    own_steps = [-at_once - through @ step for at_once, through in inner]
    gain = -gradient @ step - step @ matrix @ step / 2
    for (g, B, C), change in zip(runs, own_steps, strict=True):
        gain -= g @ change + change @ C @ change / 2 + step @ B @ change
    return step, own_steps, float(gain)


def shared_information(unknowns: Unknowns, parts: Sequence[RunPart]) -> Array:
    """Fisher information of the shared unknowns with prior, each run's own unknowns eliminated, (k, k)."""
    _, matrix, runs = _normal_equations(unknowns, parts, unknowns.shared, unknowns.own)
    for _, B, C in runs:
        matrix = matrix - B @ np.linalg.solve(C, B.T)
    return matrix


def _normal_equations(
    unknowns: Unknowns, parts: Sequence[RunPart], shared: Array, own: Sequence[Array]
) -> tuple[Array, Array, list[tuple[Array, Array, Array]]]:
    """Gradient (k,) and matrix (k, k) of the shared unknowns; of each run its gradient, coupling and matrix."""
    gradient, matrix = shared / unknowns.shared_spread**2, np.diag(unknowns.shared_spread**-2.0)
    runs = []
    for part, mine, start, spread in zip(parts, own, unknowns.own, unknowns.own_spread, strict=True):
        by_shared, by_own = part.by_shared, part.by_own
        gradient, matrix = gradient + by_shared.T @ part.errors, matrix + by_shared.T @ by_shared
        pull = by_own.T @ part.errors + (mine - start) / spread**2
        runs.append((pull, by_shared.T @ by_own, by_own.T @ by_own + np.diag(spread**-2.0)))
    return gradient, matrix, runs

"""Normal equations of an output-error fit: unknowns of segments, then of recordings, eliminated by Schur complements.

Residuals of a simulation are correlated from row to row. They count as rows (1 - rho) / (1 + rho) independent ones,
where rho is that correlation (Bayley and Hammersley, JRSS suppl. 8, 1946), so that intervals include model error.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtrc

from continuum.arrays import Array
from continuum.discovery.quadratic_program import bounded_minimum
from continuum.discovery.segment import Segment
from continuum.discovery.unknowns import Unknown, Unknowns

_MOST_CORRELATION = 0.99
_AT_BOUND = 1e-9


@dataclass(frozen=True)
class Values:
    """Values of all unknowns.

    Attributes:
        common: values common to all recordings, (k,).
        per_run: values of each recording.
        local: values of each segment, (3 n,) each.
    """

    common: Array
    per_run: tuple[Array, ...]
    local: tuple[Array, ...]


class Scale:
    """Weights of segments: their cost is linear in the root mean square of their residuals, not quadratic (Huber 1964).

    A joint that comes to rest elsewhere spoils its whole segment; such a segment must not outweigh all others.

    Args:
        segments: segments that set the scale.
        floor: standard deviation of the sensors' white noise [rad].

    Attributes:
        independent: fraction of residuals that are independent.
        observations: number of independent residuals.
    """

    def __init__(self, segments: Sequence[Segment], floor: float) -> None:
        self.floor = floor
        self.independent = independent(sum(one.square for one in segments), sum(one.product for one in segments))
        self._typical = float(np.mean([max(one.error, floor) for one in segments]))
        self.observations: float = self.independent * sum(one.readings.size for one in segments)

    def weights(self, errors: Sequence[float]) -> list[float]:
        """Return the weights of squared residuals of segments with these errors [1/rad^2]."""
        return [self.independent / (self._typical * max(error, self.floor)) for error in errors]

    def cost(self, one: Segment) -> float:
        """Return minus the log-likelihood of a segment, up to a constant."""
        error = one.error
        if error < self.floor:
            error = 0.5 * (error**2 / self.floor + self.floor)
        return self.independent * one.readings.size * error / self._typical


def independent(square: float, product: float) -> float:
    """Return the fraction of independent residuals, from the sum of squares and that of products one row apart."""
    rho = product / square if square > 0 else 0.0
    rho = min(max(rho, 0.0), _MOST_CORRELATION) if np.isfinite(rho) else _MOST_CORRELATION
    return (1 - rho) / (1 + rho)


def prior_cost(unknowns: Unknowns, values: Values, local_precision: Array) -> float:
    """Return minus the log-prior, up to a constant."""
    of_all = [(values.common, unknowns.common), *zip(values.per_run, unknowns.per_run, strict=True)]
    common = sum(((v - one.mean) / one.sd) ** 2 for x, those in of_all for v, one in zip(x, those, strict=True))
    return 0.5 * float(common + sum(x @ (local_precision * x) for x in values.local))


@dataclass(frozen=True)
class _Run:
    """Information of one recording.

    Attributes:
        A, b: information on the common unknowns, with the others eliminated, (k, k) and (k,).
        of_segments: the same by segment, on the common and the per-run unknowns.
        per_run_prior: prior information on these, (k + m, k + m) and (k + m,).
        per_run, segments: back substitution to the per-run unknowns and to those of each segment.
        per_run_covariance: covariance of the per-run unknowns given the common ones, (m, m).
    """

    A: Array
    b: Array
    of_segments: tuple[tuple[Array, Array], ...]
    per_run_prior: tuple[Array, Array]
    per_run: Array
    segments: tuple[Array, ...]
    per_run_covariance: Array

    def without(self, segment: int) -> tuple[Array, Array, Array]:
        """Return the information on the common unknowns without a segment, and back substitution to per-run ones."""
        A, b = self.per_run_prior
        for i, (more, right) in enumerate(self.of_segments):
            if i != segment:
                A, b = A + more, b + right
        return _eliminated(A, b, len(self.b))

    def rest(self, step: Array) -> tuple[Array, tuple[Array, ...]]:
        """Return the steps of the per-run unknowns and of those of each segment."""
        per_run = self.per_run[:, -1] - self.per_run[:, :-1] @ step
        both = np.concatenate([step, per_run])
        return per_run, tuple(part[:, -1] - part[:, :-1] @ both for part in self.segments)


class WithoutEach(NamedTuple):
    """Changes when each segment in turn is left out.

    Attributes:
        moves: changes of the common unknowns, (segments, k).
        sds: their standard deviations if the model is right, (segments, k).
        errors: root mean square error of the segment that is left out, (segments,) [rad]. Its local unknowns count as
            data: one that is z prior standard deviations off counts as a residual of z times the noise in as many rows
            as contain one independent residual. Otherwise a segment could explain errors of a set by wrong zeros of
            its sensors at no cost.
    """

    moves: Array
    sds: Array
    errors: Array

    @property
    def disagreement(self) -> Array:
        """Mean square of the moves in units of their standard deviations, (k,): about 1 if segments agree."""
        size = np.divide(self.moves, self.sds, out=np.zeros_like(self.moves), where=self.sds > 0)
        return np.asarray(np.mean(size**2, axis=0))

    def probability(self, which: Sequence[int]) -> float:
        """Return the p-value of the disagreement about any of some unknowns: chi-square with Bonferroni correction."""
        df = len(self.moves) - 1
        if df < 1 or not len(which):
            return 1.0
        return min(1.0, len(which) * float(np.min(chdtrc(df, df * self.disagreement[list(which)]))))


class NormalEquations:
    """Normal equations about values at which segments were simulated.

    Args:
        unknowns, values: unknowns and their values.
        segments: segments simulated at these values.
        weights: weights of their squared residuals [1/rad^2].
        local_precision: inverse prior variances of a segment's local unknowns, (3 n,).
    """

    def __init__(
        self,
        unknowns: Unknowns,
        values: Values,
        segments: Sequence[Segment],
        weights: Sequence[float],
        local_precision: Array,
    ) -> None:
        self._unknowns, self._values, self._segments, self._weights = unknowns, values, segments, weights
        self._local_precision, local = local_precision, iter(zip(weights, values.local, strict=True))
        self._runs: list[_Run] = []
        for r, (per_run, those) in enumerate(zip(values.per_run, unknowns.per_run, strict=True)):
            k, parts, systems = len(values.common) + len(per_run), list[Array](), list[tuple[Array, Array]]()
            for one in self._of(r):
                weight, mine = next(local)
                G, h = weight * one.information, -weight * (one.residuals @ one.jacobian)
                G[k:, k:] += np.diag(local_precision)
                h[k:] -= local_precision * mine
                A, b, part = _eliminated(G, h, k)
                systems.append((A, b))
                parts.append(part)
            self._runs.append(_run(systems, parts, per_run, those))
        precision, means = _prior(unknowns.common)
        self._A = np.sum([one.A for one in self._runs], axis=0) + np.diag(precision)
        self._b = np.sum([one.b for one in self._runs], axis=0) - precision * (values.common - means)
        self._low = np.array([one.lower for one in unknowns.common]) - values.common
        self._high = np.array([one.upper for one in unknowns.common]) - values.common
        self.covariance: Array = np.linalg.inv(self._A)

    def _of(self, run: int) -> list[Segment]:
        return [one for one in self._segments if one.run == run]

    def stepped(self, damping: float) -> Values:
        """Return the values after a Levenberg-Marquardt step within the bounds."""
        A, unit = self._A + damping * np.diag(np.diag(self._A)), np.eye(len(self._low))
        low, high = np.isfinite(self._low), np.isfinite(self._high)
        G, least = np.concatenate([unit[low], -unit[high]]), np.concatenate([self._low[low], -self._high[high]])
        step = np.clip(bounded_minimum(A, self._b, G, least)[0], self._low, self._high)
        rest = [one.rest(step) for one in self._runs]
        moves = [move for _, of_segments in rest for move in of_segments]
        return Values(
            self._values.common + step,
            tuple(x + per_run for x, (per_run, _) in zip(self._values.per_run, rest, strict=True)),
            tuple(x + move for x, move in zip(self._values.local, moves, strict=True)),
        )

    def expected_residuals(self, there: Values) -> list[Array]:
        """Return the linearised residuals of each segment at other values, (rows, n) each [rad]."""
        moves = zip(self._segments, self._moves(there), strict=True)
        return [one.residuals_at(move).reshape(one.readings.shape) for one, move in moves]

    def _moves(self, there: Values) -> Iterator[Array]:
        """Yield the changes of each segment's unknowns from here to other values."""
        here = self._values
        local = iter([after - before for before, after in zip(here.local, there.local, strict=True)])
        for r, (before, after) in enumerate(zip(here.per_run, there.per_run, strict=True)):
            for _ in self._of(r):
                yield np.concatenate([there.common - here.common, after - before, next(local)])

    def expected_fall(self, there: Values) -> float:
        """Return the fall of minus the log-posterior from here to other values, with linearised residuals."""
        squares = [float(np.sum(left**2)) for left in self.expected_residuals(there)]
        falls = [one.square - square for one, square in zip(self._segments, squares, strict=True)]
        priors = [prior_cost(self._unknowns, values, self._local_precision) for values in (self._values, there)]
        return 0.5 * float(np.dot(self._weights, falls)) + priors[0] - priors[1]

    def per_run_sd(self) -> tuple[Array, ...]:
        """Return the standard deviations of the per-run unknowns, by recording."""
        out = []
        for one in self._runs:
            through = one.per_run[:, :-1]
            out.append(np.sqrt(np.diag(one.per_run_covariance + through @ self.covariance @ through.T)))
        return tuple(out)

    def without_each(self, scale: Scale) -> WithoutEach:
        """Take one Newton step from the optimum for each segment left out; its local unknowns are fitted to it.

        Args:
            scale: weights of residuals.
        """
        held = ((self._low > -_AT_BOUND) & (self._b < 0)) | ((self._high < _AT_BOUND) & (self._b > 0))
        free, k = ~held, len(held)
        whole, covariance = _solved(self._A, self._b, free)
        moves, sds, errors = list[Array](), list[Array](), list[float]()
        before = iter(self._values.local)
        for r, run in enumerate(self._runs):
            for i, one in enumerate(self._of(r)):
                step, per_run, variance = np.zeros(k), run.per_run[:, -1], np.zeros(k)
                if len(self._segments) > 1:
                    A, b, of_run = run.without(i)
                    step, without = _solved(self._A - run.A + A, self._b - run.b + b, free)
                    variance = np.diag(without) - np.diag(covariance)
                    per_run = of_run[:, -1] - of_run[:, :-1] @ step
                both = np.concatenate([step, per_run])
                local = run.segments[i][:, -1] - run.segments[i][:, :-1] @ both
                move = np.concatenate([both, local])
                moves.append(step - whole)
                sds.append(np.sqrt(np.maximum(variance, 0.0)))
                departure = np.sum(self._local_precision * (next(before) + local) ** 2)
                square = np.sum(one.residuals_at(move) ** 2) + departure * scale.floor**2 / scale.independent
                errors.append(float(np.sqrt(square / one.residuals.size)))
        return WithoutEach(np.array(moves), np.array(sds), np.array(errors))


def _solved(A: Array, b: Array, free: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Return the solution of A x = b and the inverse of A on the free unknowns; both are zero at the others."""
    x, inverse = np.zeros_like(b), np.zeros_like(A)
    if np.any(free):
        inverse[np.ix_(free, free)] = np.linalg.inv(A[np.ix_(free, free)])
        x = inverse @ b
    return x, inverse


def _run(
    systems: Sequence[tuple[Array, Array]], parts: Sequence[Array], values: Array, per_run: Sequence[Unknown]
) -> _Run:
    """Eliminate the per-run unknowns, the last in the systems of the segments."""
    precision, means = _prior(per_run)
    k = len(systems[0][1]) - len(per_run)
    prior = np.zeros_like(systems[0][0]), np.zeros_like(systems[0][1])
    prior[0][k:, k:], prior[1][k:] = np.diag(precision), -precision * (values - means)
    A, b = prior[0] + sum(A for A, _ in systems), prior[1] + sum(b for _, b in systems)
    less_A, less_b, solved = _eliminated(A, b, k)
    return _Run(less_A, less_b, tuple(systems), prior, solved, tuple(parts), np.linalg.inv(A[k:, k:]))


def _eliminated(A: Array, b: Array, k: int) -> tuple[Array, Array, Array]:
    """Return the Schur complement on the first k unknowns, (k, k) and (k,), and the back substitution, (m, k + 1)."""
    solved = np.linalg.solve(A[k:, k:], np.column_stack([A[k:, :k], b[k:]]))
    return A[:k, :k] - A[:k, k:] @ solved[:, :-1], b[:k] - A[:k, k:] @ solved[:, -1], solved


def _prior(those: Sequence[Unknown]) -> tuple[Array, Array]:
    """Return the prior precisions and means."""
    return np.array([one.sd for one in those]) ** -2.0, np.array([one.mean for one in those])

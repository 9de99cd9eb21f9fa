"""Evidence of hypotheses by linear algebra: coefficients with Gaussian priors and bounds are integrated out.

For run r and a level of the missing torque

    -2 log p(y_r | theta) = energy_r - 2 theta' e_r + theta' L_r theta + log_det_r.

A hypothesis is a linear map H from its coefficients a to theta. The nuisances, which are baseline parameters and
ordinary differences between parts, are integrated out once; per-run coefficients by the Schur complement of a block.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log

import numpy as np

from continuum.arrays import Array
from continuum.discovery.evidence_kernel import evidences
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.quadratic_program import bounded_minimum
from continuum.estimation.augmented_filter import RunLikelihood

type Set = tuple[Hypothesis, ...]


@dataclass(frozen=True)
class Nuisance:
    """Coefficients that all hypotheses share.

    Attributes:
        columns: indices, (k,).
        sd: prior standard deviations about zero, (k,).
        constraints, least: rows G theta >= least that keep the baseline physical, (m, P) and (m,).
        most: largest size of each coefficient, infinite if it has none, (k,).
    """

    columns: Array
    sd: Array
    constraints: Array
    least: Array
    most: Array

    @property
    def bounds(self) -> tuple[Array, Array]:
        """Rows and lower bounds of -most <= coefficient <= most, (m, k) and (m,)."""
        used = np.flatnonzero(np.isfinite(self.most))
        rows = np.zeros((used.size, self.sd.size))
        rows[np.arange(used.size), used] = 1.0
        return np.concatenate([rows, -rows]), -np.concatenate([self.most[used]] * 2)


@dataclass(frozen=True)
class Optimum:
    """Most probable coefficients of a set within all bounds.

    Attributes:
        theta: coefficients of all columns, (P,).
        values, sd: the set's coefficients and their standard deviations.
        local_columns: columns with per-run coefficients.
        local: these coefficients, (runs, k).
        rise: amount by which the bounds raise minus the log-posterior.
        covariance: covariance of the set's coefficients.
    """

    theta: Array
    values: Array
    sd: Array
    local_columns: Array
    local: Array
    rise: float
    covariance: Array


class Evidence:
    """Log-evidence of any set of hypotheses at several levels of the missing torque.

    Args:
        runs: likelihoods, by level and run, about theta = 0.
        nuisance: coefficients common to all sets.
        hypotheses: all hypotheses that sets may contain.
        width: number of columns.
        prior_levels: number of levels that are equally probable a priori; those not in ``runs`` have no evidence.
    """

    def __init__(
        self, runs: Sequence[Sequence[RunLikelihood]], nuisance: Nuisance, hypotheses: Sequence[Hypothesis], width: int,
        prior_levels: int,
    ) -> None:  # fmt: skip
        self._prior_levels = prior_levels
        self.runs, self.nuisance, self.width = runs, nuisance, width
        self._at: dict[int, slice] = {}
        maps, end = [], 0
        for hypothesis in hypotheses:
            k = len(hypothesis.columns)
            self._at[id(hypothesis)] = slice(end, end + k)
            maps.append(hypothesis.map(width))
            end += k
        self._H = np.hstack(maps) if maps else np.zeros((width, 0))
        self._reduced: dict[tuple[int, ...], tuple[Array, ...]] = {}
        self._memo: dict[frozenset[int], tuple[Array, Array]] = {}
        self._constrained: dict[frozenset[int], Array] = {}

    @property
    def n_levels(self) -> int:
        """Number of levels."""
        return len(self.runs)

    def by_level(self, chosen: Set, with_constraints: bool = False) -> Array:
        """Return the log-evidence at each level, (n_levels,)."""
        key = frozenset(id(h) for h in chosen)
        if key not in self._memo:
            local, local_sd = local_of(chosen)
            parts = self._without_nuisances(local, local_sd)
            index = np.concatenate(
                [np.zeros(0), *(np.arange(self._at[id(h)].start, self._at[id(h)].stop) for h in chosen)]
            )
            sd = np.concatenate([np.zeros(0), *(h.sd for h in chosen)])
            least = np.concatenate([np.zeros(0), *(h.least for h in chosen)])
            found, worst = np.empty(self.n_levels), np.empty(self.n_levels)
            evidences(*parts, index.astype(np.int64), sd, least, found, worst)
            self._memo[key] = found, worst
        found, worst = self._memo[key]
        if not with_constraints or not np.any(worst < -1e-9):
            return found
        if key not in self._constrained:
            bounded = found.copy()
            for k in np.argsort(-found):
                if found[k] < bounded.max() - 10 and k != int(np.argmax(found)):
                    continue
                if worst[k] < -1e-9:
                    bounded[k] -= self.optimum(chosen, int(k), run_bounds=False).rise
            self._constrained[key] = bounded
        return self._constrained[key]

    def total(self, chosen: Set, with_constraints: bool = False) -> float:
        """Return the log-evidence with all levels equally probable a priori."""
        return logsum(self.by_level(chosen, with_constraints)) - log(self._prior_levels)

    def best_level(self, chosen: Set) -> int:
        """Return the index of the most probable level."""
        return int(np.argmax(self.by_level(chosen, with_constraints=True)))

    def ranked(self, sets: Sequence[Set], price: float, enough: int) -> list[tuple[float, Set]]:
        """Return the best sets by log-evidence minus a price per effect, constraints included; at least ``enough``.

        Constraints only lower an evidence, so they are evaluated from the top until no other set can be better.
        """
        free = sorted(((self.total(s) - price * len(s), i) for i, s in enumerate(sets)), key=lambda pair: -pair[0])
        found: list[tuple[float, Set]] = []
        for at, (bound, i) in enumerate(free):
            best = sorted((value for value, _ in found), reverse=True)
            if (len(best) >= enough and best[enough - 1] >= bound) or at > 4 * enough:
                break
            if np.isfinite(bound):
                found.append((self.total(sets[i], with_constraints=True) - price * len(sets[i]), sets[i]))
        return sorted(found, key=lambda pair: -pair[0])

    def _without_nuisances(self, local: tuple[int, ...], local_sd: tuple[float, ...]) -> tuple[Array, ...]:
        """Return the information on all coefficients by level: L, e, constant, constraints and their values."""
        if local not in self._reduced:
            parts = [self._reduced_at(level, local, local_sd) for level in range(self.n_levels)]
            self._reduced[local] = tuple(np.array(part) for part in zip(*parts, strict=True))
        return self._reduced[local]

    def _reduced_at(self, level: int, local: tuple[int, ...], local_sd: tuple[float, ...]) -> tuple[Array, ...]:
        L, e, constant = np.zeros((self.width, self.width)), np.zeros(self.width), 0.0
        for run in self.runs[level]:
            Lr, er, c = without_local(run, np.array(local, dtype=int), np.array(local_sd))
            L, e, constant = L + Lr, e + er, constant + c
        nu, sd = self.nuisance.columns, self.nuisance.sd
        chol = np.linalg.cholesky(L[np.ix_(nu, nu)] + np.diag(sd**-2.0))
        Z = np.linalg.solve(chol, np.column_stack([L[nu], e[nu]]))
        constant += 0.5 * Z[:, -1] @ Z[:, -1] - np.log(np.diag(chol)).sum() - np.log(sd).sum()
        Y = np.linalg.solve(chol.T, Z)
        H, G = self._H, self.nuisance.constraints
        LH = (L - Z[:, :-1].T @ Z[:, :-1]) @ H
        bounds, low = self.nuisance.bounds
        of_nuisances, direct = np.concatenate([G[:, nu], bounds]), np.zeros((len(bounds), H.shape[1]))
        return (
            H.T @ LH,
            H.T @ (e - Z[:, :-1].T @ Z[:, -1]),
            constant,
            np.concatenate([G @ H, direct]) - of_nuisances @ (Y[:, :-1] @ H),
            of_nuisances @ Y[:, -1] - np.concatenate([self.nuisance.least, low]),
        )

    def system(self, chosen: Set, level: int) -> tuple[Array, Array, list[tuple[Array, Array, float]], list[Array]]:
        """Return the linear system of the nuisances and the set's coefficients.

        Returns:
            Map to theta, prior standard deviations, each run's (L, e, constant), and for each run the columns
            (k, P + 1) that give its per-run coefficients: last column minus the others times theta.
        """
        unit = np.eye(self.width)[:, self.nuisance.columns.astype(int)]
        H = np.hstack([unit, *(h.map(self.width) for h in chosen)])
        sd = np.concatenate([self.nuisance.sd, *(h.sd for h in chosen)])
        local, local_sd = (np.array(x) for x in local_of(chosen))
        local = local.astype(int)
        runs, per_run = [], []
        for run in self.runs[level]:
            Lr, er, c = without_local(run, local, local_sd)
            runs.append((H.T @ Lr @ H, H.T @ er, c))
            if local.size:
                A = run.L[np.ix_(local, local)] + np.diag(local_sd**-2.0)
                per_run.append(np.linalg.solve(A, np.column_stack([run.L[local], run.e[local]])))
            else:
                per_run.append(np.zeros((0, self.width + 1)))
        return H, sd, runs, per_run

    def optimum(self, chosen: Set, level: int, run_bounds: bool = True) -> Optimum:
        """Return the most probable coefficients within the constraints and, if ``run_bounds``, the set's bounds."""
        H, sd, runs, per_run = self.system(chosen, level)
        A = np.sum([L for L, _, _ in runs], axis=0) + np.diag(sd**-2.0)
        b: Array = np.sum([e for _, e, _ in runs], axis=0)
        bounds, low = self.nuisance.bounds
        at = self.nuisance.sd.size
        bounds = np.hstack([bounds, np.zeros((len(bounds), sd.size - at))])
        G, least = [self.nuisance.constraints @ H, bounds], [self.nuisance.least, low]
        if run_bounds:
            lower = np.concatenate([np.zeros(0), *(h.least for h in chosen)])
            rows = np.flatnonzero(np.isfinite(lower))
            bound = np.zeros((rows.size, sd.size))
            bound[np.arange(rows.size), at + rows] = 1.0
            G.append(bound)
            least.append(lower[rows])
        a, rise = bounded_minimum(A, b, np.concatenate(G), np.concatenate(least))
        covariance = np.linalg.inv(A)[at:, at:]
        theta = H @ a
        local = np.array([solve[:, -1] - solve[:, :-1] @ theta for solve in per_run])
        columns = np.array(local_of(chosen)[0], dtype=int)
        return Optimum(theta, a[at:], np.sqrt(np.diag(covariance)), columns, local, rise, covariance)


def local_of(chosen: Set) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """Return the columns with per-run coefficients, and their prior standard deviations."""
    columns = tuple(c for h in chosen for c in h.local)
    return columns, tuple(float(s) for h in chosen for s in h.local_sd)


def without_local(run: RunLikelihood, local: Array, sd: Array) -> tuple[Array, Array, float]:
    """Return a run's information with its per-run coefficients integrated out: L, e, constant of the log-likelihood."""
    constant = -0.5 * (run.energy + run.log_det)
    if not local.size:
        return run.L, run.e, constant
    A = run.L[np.ix_(local, local)] + np.diag(sd**-2.0)
    chol = np.linalg.cholesky(A)
    Z = np.linalg.solve(chol, np.column_stack([run.L[local], run.e[local]]))
    constant += 0.5 * Z[:, -1] @ Z[:, -1] - np.log(np.diag(chol)).sum() - np.log(sd).sum()
    return run.L - Z[:, :-1].T @ Z[:, :-1], run.e - Z[:, :-1].T @ Z[:, -1], float(constant)


def _half_form(A: Array, b: Array) -> float:
    chol = np.linalg.cholesky(A)
    z = np.linalg.solve(chol, b)
    return float(0.5 * z @ z - np.log(np.diag(chol)).sum())


def logsum(values: Array) -> float:
    """Return log(sum(exp(values)))."""
    top = float(np.max(values))
    return top + float(np.log(np.sum(np.exp(values - top)))) if np.isfinite(top) else -np.inf

"""Random likelihoods, nuisances and hypotheses, and integrals over their coefficients by points in every direction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
import scipy.special

from continuum.discovery.evidence import Evidence, Nuisance
from continuum.discovery.hypotheses import Coefficient, Hypothesis
from continuum.estimation.augmented_filter import RunLikelihood

WIDTH = 6
NUISANCES = np.array([1, 4])
NONE = np.zeros(0)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def hypothesis(
    columns: Sequence[tuple[int, ...]], sd: np.ndarray, least: np.ndarray, local: tuple[int, ...] = (), **also: object
) -> Hypothesis:
    """One of a coefficient for each group of columns."""
    meanings = tuple(Coefficient("slot", "any", str(k)) for k in range(len(columns)))
    return Hypothesis("any", None, tuple(columns), meanings, sd, least, local, **also)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Drawn:
    """Random likelihoods of three runs at two levels, nuisances, and hypotheses.

    Attributes:
        runs: by level.
        nuisance: two coefficients.
        pair: a hypothesis of two coefficients, one of which moves two columns alike.
        per_run: one that has a separate coefficient in each run.
    """

    runs: list[list[RunLikelihood]]
    nuisance: Nuisance
    pair: Hypothesis
    per_run: Hypothesis

    @classmethod
    def by(cls, seed: int) -> Self:
        """Eight whitened readings in each run."""
        random = np.random.default_rng(seed)
        runs = []
        for _ in range(2):
            whitened = [(random.normal(0, 1, (8, WIDTH)), random.normal(0, 2, 8)) for _ in range(3)]
            runs.append([RunLikelihood(Z.T @ Z, Z.T @ z, float(z @ z), float(random.normal())) for Z, z in whitened])
        sds, free = random.uniform(0.3, 2, (2, 2)), np.full(2, -np.inf)
        nuisance = Nuisance(NUISANCES, sds[0], np.zeros((0, WIDTH)), NONE, np.full(2, np.inf))
        pair = hypothesis([(0, 2), (5,)], sds[1], free)
        return cls(runs, nuisance, pair, hypothesis([], NONE, NONE, (3,), local_sd=random.uniform(0.3, 2, 1)))

    def evidence(self, *hypotheses: Hypothesis, runs: list[list[RunLikelihood]] | None = None) -> Evidence:
        """Of hypotheses about these runs, or about others."""
        return Evidence(runs or self.runs, self.nuisance, hypotheses, WIDTH, len(self.runs))

    def quadratic(self, level: int, chosen: Sequence[Hypothesis]) -> tuple[np.ndarray, np.ndarray, float]:
        """A, b, c of log p(y, a) = c + b'a - a'Aa / 2, a: nuisances, the set's coefficients, then those of each run."""
        unit, local = np.eye(WIDTH), [column for h in chosen for column in h.local]
        common = np.hstack([unit[:, NUISANCES], *(h.map(WIDTH) for h in chosen)])
        sd = [self.nuisance.sd, *(h.sd for h in chosen), *([h.local_sd for h in chosen] * 3 if local else [])]
        precision = np.concatenate(sd) ** -2.0
        A, b, c = np.diag(precision), np.zeros(precision.size), 0.5 * np.sum(np.log(precision / (2 * np.pi)))
        for r, run in enumerate(self.runs[level]):
            per_run = [unit[:, local] * (r == other) for other in range(3)] if local else []
            H = np.hstack([common, *per_run])
            A, b, c = A + H.T @ run.L @ H, b + H.T @ run.e, c - 0.5 * (run.energy + run.log_det)
        return A, b, float(c)


def log_integral(A: np.ndarray, b: np.ndarray, c: float, least: np.ndarray) -> float:
    """Log of the integral of exp(c + b'a - a'Aa / 2) over all a above their bounds, by points in every direction."""
    center, sds = np.linalg.solve(A, b), np.sqrt(np.diag(np.linalg.inv(A)))
    grids, factors = [], []
    for low, middle, wide in zip(least, center, sds, strict=True):
        begin, end = max(low, middle - 8 * wide), max(low, middle) + 8 * wide
        if middle < low:  # what is left falls off from the bound on
            end = low + min(8 * wide, 40 * wide**2 / (low - middle))
        grids.append(begin + (end - begin) * (NODES + 1) / 2)
        factors.append(np.log(WEIGHTS * (end - begin) / 2))
    points = np.stack(np.meshgrid(*grids, indexing="ij"), axis=-1).reshape(-1, b.size)
    weights = np.stack(np.meshgrid(*factors, indexing="ij"), axis=-1).reshape(-1, b.size).sum(axis=1)
    return float(scipy.special.logsumexp(c + points @ b - 0.5 * np.sum(points @ A * points, axis=1) + weights))


def without(A: np.ndarray, b: np.ndarray, c: float, integrated: Sequence[int]) -> tuple[np.ndarray, np.ndarray, float]:
    """The same with some of a integrated out in closed form."""
    kept = [k for k in range(b.size) if k not in integrated]
    inner, across = A[np.ix_(integrated, integrated)], A[np.ix_(integrated, kept)]
    solved = np.linalg.solve(inner, np.column_stack([across, b[list(integrated)]]))
    constant = 0.5 * b[list(integrated)] @ solved[:, -1] - 0.5 * np.linalg.slogdet(inner / (2 * np.pi))[1]
    return A[np.ix_(kept, kept)] - across.T @ solved[:, :-1], b[kept] - across.T @ solved[:, -1], c + constant

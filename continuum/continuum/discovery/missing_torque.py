"""The torque that a set of effects leaves missing, joint by joint: its size by expectation-maximisation, and its course."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.discovery.problem import Problem
from continuum.discovery.search import Found
from continuum.estimation.augmented_filter import smoothed

_ITERATIONS = 4  # of expectation-maximisation: sizes have settled to some percent


def missing_torque(problem: Problem, found: Found) -> tuple[Array, tuple[Array, ...]]:
    """Standard deviation at each joint, (n,) [N m], and smoothed torque of every run, (n_times, n) [N m]."""
    lin, n = found.lin, problem.structure.n
    level = lin.evidence.best_level(found.chosen)
    best = lin.evidence.optimum(found.chosen, level)
    sigma = np.full(n, float(np.mean(problem.noise.sigma)) * problem.levels[lin.levels[level]])
    courses: list[Array] = []
    for _ in range(_ITERATIONS):
        squares, count, courses = np.zeros(n), 0, []
        for r, (run, way, one) in enumerate(zip(problem.runs, lin.state.ways, lin.runs, strict=True)):
            theta = best.theta - lin.theta[r]
            if best.local_columns.size:
                theta[best.local_columns] += best.local[r]
            added = one.columns[0] @ theta, one.columns[1] @ theta
            states, variances, _ = smoothed(run, way, one.step, one.seen, added, problem.noise.at(sigma))
            squares += np.sum(states[:, 3 * n :] ** 2 + variances[:, 3 * n :], axis=0)
            count += len(states)
            courses.append(states[:, 3 * n :])
        sigma = np.sqrt(squares / count)
    return sigma, tuple(courses)

"""The torque that a set of effects leaves missing: its size by expectation-maximisation, and its time course."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.discovery.gauss_newton import smoothed_runs
from continuum.discovery.problem import Problem
from continuum.discovery.search import Found

_ITERATIONS = 4  # of expectation-maximisation, after which sizes have settled to a few percent


def missing_torque(problem: Problem, found: Found) -> tuple[Array, tuple[Array, ...]]:
    """Return the standard deviation at each joint, (n,) [N m], and the smoothed torques, (n_times, n) per run [N m]."""
    lin, n = found.lin, problem.structure.n
    level = lin.evidence.best_level(found.chosen)
    best = lin.evidence.optimum(found.chosen, level)
    sigma = problem.noise.sigma * problem.levels[lin.levels[level]]
    courses: list[Array] = []
    for _ in range(_ITERATIONS):
        squares, count, courses = np.zeros(n), 0, []
        for states, variances in smoothed_runs(lin, best, sigma):
            squares += np.sum(states[:, 3 * n :] ** 2 + variances[:, 3 * n :], axis=0)
            count += len(states)
            courses.append(states[:, 3 * n :])
        sigma = np.sqrt(squares / count)
    return sigma, tuple(courses)

"""The rivals: plain FABRIKc, the textbook's damped least squares, and SciPy's least squares."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import least_squares

from continuum.arrays import Array
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.fabrikc import solve_fabrikc
from continuum.kinematics.ik_target import Target
from tools.bench_ik.sample import Sample

Rival = Callable[[Sample, Target, float], tuple[Array, int]]
"""Configuration (n_sections, 2) [rad] and iterations for a target and a tolerance [m], [rad]."""


def fabrikc(max_iterations: int) -> Rival:
    """FABRIKc alone, from the straight arm."""

    def solve(sample: Sample, target: Target, tolerance: float) -> tuple[Array, int]:
        result = solve_fabrikc(sample.arm, target.position, target.direction, None, tolerance, max_iterations)
        return result.configuration, result.iterations

    return solve


def scipy_least_squares(method: str) -> Rival:
    """SciPy's ``lm`` (MINPACK's Levenberg-Marquardt) or ``trf`` with the exact Jacobian, from a nearly straight arm."""

    def solve(sample: Sample, target: Target, _: float) -> tuple[Array, int]:
        weight = 0.1 * sample.arm.length

        def error(x: Array) -> Array:
            pose = arm_pose(x.reshape(-1, 2), sample.arm)
            return np.concatenate([pose[:3, 3] - target.position, weight * (pose[:3, 2] - target.direction)])

        def jacobian(x: Array) -> Array:
            w = x.reshape(-1, 2)
            rows = arm_jacobian(w, sample.arm)
            return np.concatenate([rows[:3], weight * np.cross(rows[3:], arm_pose(w, sample.arm)[:3, 2], axisa=0).T])

        n = 2 * sample.arm.n_sections
        chosen = "trf" if n > 6 else method  # MINPACK wants no fewer equations than unknowns
        found = least_squares(error, np.full(n, 0.01), jacobian, method=chosen, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        return found.x.reshape(-1, 2), found.nfev

    return solve


def damped_least_squares(sample: Sample, target: Target, tolerance: float) -> tuple[Array, int]:
    """The textbook's J^T (J J^T + lambda^2)^-1 e with a constant lambda of 5 mm, up to 500 steps, in NumPy."""
    weight = 0.1 * sample.arm.length
    w = np.full((sample.arm.n_sections, 2), 0.01)
    for iteration in range(500):
        pose, rows = arm_pose(w, sample.arm), arm_jacobian(w, sample.arm)
        error = np.concatenate([target.position - pose[:3, 3], weight * (target.direction - pose[:3, 2])])
        if np.linalg.norm(error) <= 0.1 * tolerance:
            return w, iteration
        jacobian = np.concatenate([rows[:3], weight * np.cross(rows[3:], pose[:3, 2], axisa=0).T])
        step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 0.005**2 * np.eye(6), error)
        w = w + step.reshape(-1, 2)
    return w, 500

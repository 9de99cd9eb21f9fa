"""The rivals: plain FABRIKc, the textbook's damped least squares, and SciPy's least squares."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import least_squares

from continuum.arrays import Array
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.fabrikc import solve_fabrikc
from continuum.kinematics.ik_target import Target
from tools.benchmarks.ik.sample import Sample

Rival = Callable[[Sample, Target, float], tuple[Array, int]]
"""Configuration (n_sections, 2) [rad] and iterations for a target and a tolerance [m], [rad]."""


def fabrikc(max_iterations: int) -> Rival:
    """FABRIKc alone, from the straight arm."""

    def solve(sample: Sample, target: Target, tolerance: float) -> tuple[Array, int]:
        result = solve_fabrikc(sample.arm, target.position, target.direction, None, tolerance, max_iterations)
        return result.configuration, result.iterations

    return solve


class _ArrivedError(Exception):
    """End a search of SciPy, which has no tolerance for the tip, when the tip has arrived."""

    def __init__(self, x: Array) -> None:
        self.x = x


def scipy_least_squares(method: str) -> Rival:
    """SciPy's ``lm`` (MINPACK's Levenberg-Marquardt) or ``trf`` with the exact Jacobian, from a nearly straight arm.

    The search stops as soon as the tip is within the tolerance.
    """

    def solve(sample: Sample, target: Target, tolerance: float) -> tuple[Array, int]:
        n_calls = 0

        def error(x: Array) -> Array:
            nonlocal n_calls
            n_calls += 1
            rows, is_there = tip_error(sample, target, x.reshape(-1, 2), tolerance)
            if is_there:
                raise _ArrivedError(x.copy())
            return -rows

        def jacobian(x: Array) -> Array:
            return tip_derivatives(sample, x.reshape(-1, 2))

        start = np.full(2 * sample.arm.n_sections, 0.01)
        try:
            x = least_squares(error, start, jacobian, method=method, xtol=1e-15, ftol=1e-15, gtol=1e-15).x
        except _ArrivedError as arrived:
            x = arrived.x
        return x.reshape(-1, 2), n_calls

    return solve


def damped_least_squares(sample: Sample, target: Target, tolerance: float) -> tuple[Array, int]:
    """The textbook's J^T (J J^T + lambda^2)^-1 e with a constant lambda of 5 mm, up to 500 steps, in NumPy."""
    w = np.full((sample.arm.n_sections, 2), 0.01)
    for iteration in range(500):
        error, is_there = tip_error(sample, target, w, tolerance)
        if is_there:
            return w, iteration
        jacobian = tip_derivatives(sample, w)
        step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 0.005**2 * np.eye(6), error)
        w = w + step.reshape(-1, 2)
    return w, 500


def tip_error(sample: Sample, target: Target, w: Array, tolerance: float) -> tuple[Array, bool]:
    """Return the tip error (6,) [m], its direction weighted by a tenth of the length, and whether it is solved."""
    pose = arm_pose(w, sample.arm)
    position, direction = target.position - pose[:3, 3], target.direction - pose[:3, 2]
    is_there = np.linalg.norm(position) <= tolerance and np.linalg.norm(direction) <= tolerance
    return np.concatenate([position, 0.1 * sample.arm.length * direction]), bool(is_there)


def tip_derivatives(sample: Sample, w: Array) -> Array:
    """Return the jacobian of position and direction (6, 2 n_sections), with the same weights [m/rad]."""
    rows = arm_jacobian(w, sample.arm)
    turned = np.cross(rows[3:], arm_pose(w, sample.arm)[:3, 2], axisa=0).T
    return np.concatenate([rows[:3], 0.1 * sample.arm.length * turned])

"""Damped Gauss-Newton on the analytic Jacobian: brings a configuration to a target that it can reach."""

from __future__ import annotations

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.bend_limits import within_limits, without_outward
from continuum.kinematics.ik_result import IkResult, IkStatus, Target, configuration_of
from continuum.kinematics.tip_task import TipTask

_LARGEST_STEP = 0.5  # of any coordinate in one iteration [rad]
_STALLED = 1e-4  # relative decrease of the squared error below which the search has ended


def refine(
    arm: Arm, target: Target, start: Array | None = None, tolerance: float = 1e-6, max_iterations: int = 50
) -> IkResult:
    """Move from ``start`` (n_sections, 2) [rad] to the target by the shortest steps; bend limits are kept.

    Levenberg's damping: a step that does not lessen the error is tried again shorter. Where the error cannot vanish the
    answer is NO_CONVERGENCE; :func:`~continuum.kinematics.nearest_pose.nearest_pose` goes on from there.

    Args:
        arm: the arm.
        target: position, and direction unless it is free.
        start: where to begin; the straight arm without it.
        tolerance: largest distance [m], and largest angle [rad], that counts as solved.
        max_iterations: steps tried.
    """
    task = TipTask(arm, target)
    w = within_limits(configuration_of(arm, start), arm)
    error = task.error(w)
    damping = 0.0
    iteration = 0
    while True:
        distance, angle = task.distance_and_angle(w)
        solved = distance <= tolerance and angle <= tolerance
        if solved or iteration >= max_iterations:
            break
        jacobian = task.jacobian(w)
        scale = float(np.trace(jacobian @ jacobian.T))
        improved = False
        while not improved and damping < 1e6 and iteration < max_iterations:
            iteration += 1
            candidate = within_limits(w + _step(jacobian, error, damping * scale, w, arm), arm)
            candidate_error = task.error(candidate)
            improved = bool(candidate_error @ candidate_error < (1.0 - _STALLED) * (error @ error))
            damping = 0.1 * damping if improved else max(10.0 * damping, 1e-6)
        if not improved:
            break
        if damping < 1e-9:
            damping = 0.0
        w, error = candidate, candidate_error
    status = IkStatus.SOLVED if solved else IkStatus.NO_CONVERGENCE
    return IkResult(w, status, iteration, distance, angle)


def _step(jacobian: Array, error: Array, damping: float, w: Array, arm: Arm) -> Array:
    """Damped least-squares step (n_sections, 2) [rad] for the error that remains."""
    step = damped_solve(jacobian, error, damping).reshape(w.shape)
    held = without_outward(jacobian, w, step, arm)
    if not np.array_equal(held, jacobian):
        step = damped_solve(held, error, damping).reshape(w.shape)
    return step * min(1.0, _LARGEST_STEP / max(float(np.max(np.abs(step))), 1e-300))


def damped_solve(jacobian: Array, error: Array, damping: float) -> Array:
    """Vector x (k,) of least norm that minimises |J x - e|^2 + damping |x|^2, by singular values of J (m, k)."""
    left, values, right = np.linalg.svd(jacobian, full_matrices=False)
    smallest = 1e-9 * max(float(values[0]), 1e-300)
    used = values > smallest
    gains = used * values / np.where(used, values**2 + damping, 1.0)
    return right.T @ (gains * (left.T @ error))

"""Descent from one start: Gauss-Newton with Levenberg's damping on the analytic Jacobian, within the bend limits."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.equations import merged
from continuum.kinematics.compiled.least_squares_step import least_squares_step
from continuum.kinematics.compiled.limits import hold_outward, pull_within
from continuum.kinematics.compiled.task import TargetArrays, fill_task_jacobian, miss, squared

_LARGEST_STEP = 1.0  # of any coordinate in one iteration [rad]
_ROUNDING = 1e-16  # keeps the normal equations definite where the Jacobian has lost rank [m2]
_SLOW = 0.98  # slow progress: an iteration leaves more than this fraction of the squared error
_N_SLOW = 4  # consecutive iterations with slow progress that end the search
_N_REFUSED = 8  # consecutive rejected steps that end the search


@merged
def descend(
    arm: ArmArrays, target: TargetArrays, w: Array, tolerance: float, max_iterations: int, damping: float
) -> tuple[int, float, float, bool]:
    """Move ``w`` (2 n_sections,) [rad] in place towards the target by short steps.

    The damping follows the squared error, so that convergence is quadratic where the error vanishes.

    Returns:
        Iterations, distance [m], angle [rad], and whether both are within the tolerance.
    """
    size = len(w)
    jacobian = np.empty((6, size))
    error, trial_error = np.empty(target.n_rows), np.empty(target.n_rows)
    bases, tips = np.empty((len(arm.b) + 1, 9)), np.empty((len(arm.b), 3))
    normal = np.empty((max(6, size), max(6, size)))
    step, trial = np.empty(size), np.empty(size)
    held = np.empty(len(arm.b), np.bool_)
    pull_within(arm, w)
    distance, angle = miss(arm, target, w, error, bases, tips)
    cost = squared(error)
    n_slow = n_refused = 0
    longest = _LARGEST_STEP
    has_moved = True
    for iteration in range(max_iterations):
        if distance <= tolerance and angle <= tolerance:
            return iteration, distance, angle, True
        if has_moved:
            fill_task_jacobian(arm, target, w, bases, tips, jacobian)
        held[:] = False
        while True:
            least_squares_step(jacobian, error, damping * cost + _ROUNDING, normal, step)
            if not hold_outward(arm, w, step, held, jacobian, target.n_rows, 0.0):
                break
        largest = np.max(np.abs(step))
        scale = 1.0 if largest < longest else longest / largest
        for k in range(size):
            trial[k] = w[k] + scale * step[k]
        pull_within(arm, trial)
        trial_distance, trial_angle = miss(arm, target, trial, trial_error, bases, tips)
        trial_cost = squared(trial_error)
        has_moved = trial_cost < cost
        if has_moved:
            n_slow = n_slow + 1 if trial_cost > _SLOW * cost else 0
            w[:] = trial
            error, trial_error = trial_error, error
            distance, angle, cost = trial_distance, trial_angle, trial_cost
            damping = max(0.2 * damping, 1e-9)
            longest = min(2.0 * longest, _LARGEST_STEP)
            n_refused = 0
        else:
            damping *= 8.0
            longest = 0.25 * scale * largest
            n_refused += 1
        if n_slow >= _N_SLOW or n_refused >= _N_REFUSED or damping > 1e7:
            return iteration + 1, distance, angle, distance <= tolerance and angle <= tolerance
    return max_iterations, distance, angle, distance <= tolerance and angle <= tolerance

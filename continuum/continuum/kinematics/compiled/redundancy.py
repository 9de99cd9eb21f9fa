"""Use of the redundancy: move a solution to the nearby solution that is nearest to a reference configuration.

The reference is the configuration that the search started from, or the straight arm, which gives the least bend. The
search is Newton's method on the Lagrangian |w - reference|^2 / 2 - multipliers . conditions, in the directions that do
not change the conditions; each step is corrected onto the target. Where the Hessian is not positive definite, damping
is added until the step approaches one down the gradient.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.constraints import (
    Conditions,
    fill_normals,
    inner,
    no_conditions,
    press,
    press_on_held,
    restore,
    way_to_limits,
)
from continuum.kinematics.compiled.equations import compiled, merged
from continuum.kinematics.compiled.least_squares_step import solve_positive_definite
from continuum.kinematics.compiled.task import TargetArrays, squared

_MAX_ITERATIONS = 100
_STATIONARY = 1e-9  # free component of the vector to the reference that ends the search [rad]
_LARGEST_DAMPING = 1e6
_LARGEST_STEP = 0.5  # of any coordinate in one iteration [rad]
_SMALL_STEP = 1e-4  # below this step the residual error of the corrections hides the gain [rad]
_SLACK = 1e-11  # residual error of the corrections in the squared distance to the reference [rad2]
_DIFFERENCE = 1e-7  # step of the differences [rad]


@compiled
def slide_towards(arm: ArmArrays, target: TargetArrays, w: Array, reference: Array, tolerance: float) -> int:
    """Move the solution ``w`` (2 n_sections,) [rad] in place towards ``reference``; return the iterations."""
    size = len(w)
    if target.n_rows >= size:
        return 0
    conditions, of_trial = no_conditions(len(arm.b), target.n_rows), no_conditions(len(arm.b), target.n_rows)
    change, trial = np.empty(size), w.copy()
    restore(arm, target, w, of_trial)
    damping = 0.0
    for iteration in range(_MAX_ITERATIONS):
        gradient = w - reference
        rank = press(arm, target, w, gradient, conditions)
        descent = _descent_along(conditions.basis[rank:], gradient)
        if squared(descent) < _STATIONARY**2:
            return iteration
        hessian = _hessian(arm, target, w, reference, rank, conditions)
        moved = False
        while not moved and damping < _LARGEST_DAMPING:
            if _newton_step(hessian, descent, damping, conditions.basis[rank:], change):
                part, meets_limit = way_to_limits(arm, w, change, conditions.held)
                if meets_limit:
                    rank = press_on_held(arm, target, w, gradient, conditions)
                    descent = _descent_along(conditions.basis[rank:], gradient)
                    hessian = _hessian(arm, target, w, reference, rank, conditions)
                    continue
                trial, largest = _stepped(w, part, change)
                of_trial.held[:] = conditions.held
                distance, angle = restore(arm, target, trial, of_trial)
                gain = squared(gradient) - squared(trial - reference)
                moved = distance <= tolerance and angle <= tolerance
                moved = moved and (gain > 0.0 or (0.0 < largest < _SMALL_STEP and gain > -_SLACK))
            if not moved:
                damping = max(4.0 * damping, 0.25)
        if not moved:
            return iteration + 1
        w[:] = trial
        damping = 0.1 * damping if damping > 1e-2 else 0.0
    return _MAX_ITERATIONS


@compiled
def _descent_along(rows: Array, gradient: Array) -> Array:
    """Descent along each of the orthonormal ``rows``."""
    descent = np.empty(len(rows))
    for k in range(len(rows)):
        descent[k] = -inner(rows[k], gradient)
    return descent


@merged
def _newton_step(hessian: Array, descent: Array, damping: float, rows: Array, change: Array) -> bool:
    """Fill ``change`` (2 n_sections,) with a Newton step along ``rows``; False if the damped Hessian is indefinite."""
    step, damped = descent.copy(), hessian.copy()
    for k in range(len(step)):
        damped[k, k] += damping
    if not solve_positive_definite(damped, step):
        return False
    change[:] = 0.0
    for k in range(len(step)):
        for c in range(len(change)):
            change[c] += step[k] * rows[k, c]
    return True


@merged
def _stepped(w: Array, part: float, change: Array) -> tuple[Array, float]:
    """Return ``w`` moved by ``part`` of ``change`` or a limited step, and the largest change of a coordinate [rad]."""
    largest = np.max(np.abs(change))
    part = min(part, _LARGEST_STEP / max(largest, _LARGEST_STEP))
    return w + part * change, part * largest


@compiled
def _hessian(
    arm: ArmArrays, target: TargetArrays, w: Array, reference: Array, rank: int, conditions: Conditions
) -> Array:
    """Hessian of the Lagrangian along the free basis rows, by differences of its gradient; overwrites the normals."""
    free = conditions.basis[rank:]
    hessian = np.empty((len(free), len(free)))
    here = _lagrangian_gradient(w, reference, conditions)
    for j in range(len(free)):
        ahead = w + _DIFFERENCE * free[j]
        fill_normals(arm, target, ahead, conditions)
        there = _lagrangian_gradient(ahead, reference, conditions)
        for i in range(len(free)):
            hessian[i, j] = (inner(free[i], there) - inner(free[i], here)) / _DIFFERENCE
    return 0.5 * (hessian + hessian.T)


@compiled
def _lagrangian_gradient(w: Array, reference: Array, conditions: Conditions) -> Array:
    gradient = w - reference
    for row in range(len(conditions.multipliers)):
        multiplier = conditions.multipliers[row]
        if multiplier != 0.0:
            for k in range(len(w)):
                gradient[k] -= multiplier * conditions.normals[row, k]
    return gradient

"""Damped rates of the configurations for a velocity of the tip (thesis Eqs. 11 and 22), with a null-space motion.

rate = J+ v + (I - J+ J) wish. Damping grows smoothly from zero as a singular value of J falls below a fiftieth of the
largest (Nakamura and Hanafusa 1986). Sections at their bend limit do not bend further.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import BEND_LIMIT, ArmArrays, arrays_of
from continuum.kinematics.compiled.equations import compiled, entry_point, merged
from continuum.kinematics.compiled.limits import hold_outward, stop_radial
from continuum.kinematics.compiled.task import turn_into_tip_frame
from continuum.kinematics.compiled.tip import tip_and_jacobian
from continuum.kinematics.rigid import rotated, transposed

_NEAR_SINGULAR = 0.02  # fraction of the largest singular value below which damping starts


@merged
def tip_rate(
    arm: ArmArrays, kind: int, weight: float, w: Array, velocity: Array, spin: Array, wish: Array, ahead: float
) -> tuple[Array, Array, bool]:
    """Return the rate (2 n_sections,) [rad/s] at ``w``, the tip velocity (6,) it causes, and whether a limit held it.

    Args:
        arm: the arm.
        kind: controlled components: POSITION, DIRECTION (all but the rotation about the tip's z axis) or POSE.
        weight: length that one radian is weighted with [m].
        w: configuration (2 n_sections,) [rad].
        velocity: velocity of the tip (3,) [m/s] in ``base_link``.
        spin: angular velocity of the tip (3,) [rad/s] in ``base_link``.
        wish: rate (2 n_sections,) [rad/s] that is projected onto the null space.
        ahead: a section that would reach its limit within this time [s] is held.
    """
    geometric = np.empty((6, len(w)))
    rotation, _ = tip_and_jacobian(arm, w, geometric)
    jacobian = geometric.copy()
    turn_into_tip_frame(rotation, kind, weight, jacobian)
    local = rotated(transposed(rotation), (spin[0], spin[1], spin[2]))
    task = np.empty(kind)
    task[:3] = velocity
    for k in range(kind - 3):
        task[3 + k] = weight * local[k]
    held = np.zeros(len(arm.b), np.bool_)
    free = wish.copy()
    rate = _damped_rate(jacobian[:kind], task, free)
    while hold_outward(arm, w, rate, held, jacobian, kind, ahead):
        stop_radial(w, held, free)
        rate = _damped_rate(jacobian[:kind], task, free)
    return rate, geometric @ rate, bool(np.any(held))


@compiled
def _damped_rate(jacobian: Array, task: Array, free: Array) -> Array:
    left, values, right = np.linalg.svd(jacobian, full_matrices=False)
    threshold = max(_NEAR_SINGULAR * values[0], 1e-12)
    along = left.T @ task
    seen = right @ free
    for k in range(len(values)):
        shortfall = max(1.0 - values[k] / threshold, 0.0) * threshold
        along[k] *= values[k] / (values[k] * values[k] + shortfall * shortfall)
        if values[k] <= 1e-9 * threshold:
            seen[k] = 0.0
    return right.T @ (along - seen) + free


@entry_point
def run_tip_rate(
    table: Array, kind: int, weight: float, w: Array, velocity: Array, spin: Array, wish: Array, ahead: float
) -> Any:
    """As `tip_rate`, for an arm's table."""
    return tip_rate(arrays_of(table, table[BEND_LIMIT]), kind, weight, w, velocity, spin, wish, ahead)

"""Rates of the configurations for a velocity of the tip (thesis Eqs. 11 and 22), damped, with the null space used.

rate = J+ v + (I - J+ J) wish. Damping grows smoothly from nothing as a singular value of J falls below a fiftieth of
the largest (Nakamura and Hanafusa 1986). Sections at their bend limit are not bent further.
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

_NEAR_SINGULAR = 0.02  # of the largest singular value, below which damping sets in


@merged
def tip_rate(
    arm: ArmArrays, kind: int, weight: float, w: Array, velocity: Array, spin: Array, wish: Array, ahead: float
) -> tuple[Array, Array, bool]:
    """Rate (2 n_sections,) [rad/s] at ``w`` [rad], the tip's velocity (6,) that it gives, whether a limit held it.

    Args:
        arm: the arm.
        kind: how much of the velocity counts: POSITION, DIRECTION (all but the turn about the tip's z axis) or POSE.
        weight: what one radian counts [m].
        w: configuration (2 n_sections,) [rad].
        velocity: of the tip (3,) [m/s] in ``base_link``.
        spin: angular velocity of the tip (3,) [rad/s] in ``base_link``.
        wish: rate (2 n_sections,) [rad/s] that is followed where the velocity leaves freedom.
        ahead: time [s] within which a section that reaches its limit is held.
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
    """As `tip_rate`, of an arm's table."""
    return tip_rate(arrays_of(table, table[BEND_LIMIT]), kind, weight, w, velocity, spin, wish, ahead)

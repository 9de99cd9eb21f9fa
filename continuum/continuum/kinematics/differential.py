"""Differential inverse kinematics: rates of the configurations for a velocity of the tip (thesis Eqs. 11 and 22).

rate = J+ v + (I - J+ J) r: the least-norm answer, damped near singular postures, plus what the redundancy leaves free.
"""

from __future__ import annotations

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.bend_limits import without_outward

_NEAR_SINGULAR = 0.02  # of the largest singular value, below which damping sets in


def least_bending(w: Array, gain: float) -> Array:
    """Rate (n_sections, 2) [rad/s] down the gradient of |w|^2 / 2, for a gain [1/s]: the arm unbends where it may."""
    return -gain * w


def configuration_rate(jacobian: Array, velocity: Array, w: Array, arm: Arm, wish: Array | None = None) -> Array:
    """Rate (n_sections, 2) [rad/s] that moves the tip by ``velocity`` and, where free, follows ``wish``.

    Args:
        jacobian: (m, 2 n_sections), of the task at ``w``.
        velocity: (m,) of the task.
        w: configuration (n_sections, 2) [rad]; sections at their bend limit are not bent further.
        arm: the arm.
        wish: rate (n_sections, 2) [rad/s] for the null space of the task.
    """
    free = np.zeros(w.size) if wish is None else wish.reshape(-1)
    rate = _damped_rate(jacobian, velocity, free)
    held = without_outward(jacobian, w, rate.reshape(w.shape), arm)
    if not np.array_equal(held, jacobian):
        free = without_outward(free[None], w, rate.reshape(w.shape), arm)[0]  # a held section may not unbend either
        rate = _damped_rate(held, velocity, free)
    return rate.reshape(w.shape)


def _damped_rate(jacobian: Array, velocity: Array, free: Array) -> Array:
    left, values, right = np.linalg.svd(jacobian, full_matrices=False)
    threshold = max(_NEAR_SINGULAR * float(values[0]), 1e-12)
    # Damping grows smoothly from nothing at the threshold (Nakamura and Hanafusa 1986).
    damping = (threshold * np.clip(1.0 - values / threshold, 0.0, 1.0)) ** 2
    in_range = right[values > 1e-9 * threshold]
    along: Array = right.T @ (values / (values**2 + damping) * (left.T @ velocity))
    rate: Array = along + free - in_range.T @ (in_range @ free)
    return rate

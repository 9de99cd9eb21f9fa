"""Differential inverse kinematics of an arm: rates of its configurations for a velocity of the tip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.kinematics.compiled.arm_arrays import arm_arrays, arm_table
from continuum.kinematics.compiled.limits import pull_within
from continuum.kinematics.compiled.rate import run_tip_rate
from continuum.kinematics.compiled.task import radian_in_metres
from continuum.kinematics.ik_target import DIRECTION, POSE, POSITION, finite

__all__ = ["DIRECTION", "POSE", "POSITION", "DifferentialKinematics", "TipRate", "least_bending"]


@dataclass(frozen=True)
class TipRate:
    """Rates of the configurations, and what they do to the tip.

    Attributes:
        rate: (n_sections, 2) [rad/s].
        velocity: of the tip (3,) [m/s]; differs from the wanted one near singular postures and at bend limits.
        spin: angular velocity of the tip (3,) [rad/s].
        held: whether a section at its bend limit would have been bent further.
    """

    rate: Array
    velocity: Array
    spin: Array
    held: bool


class DifferentialKinematics:
    """Rates for one arm.

    Args:
        arm: the arm.
        kind: what of the tip's velocity counts: POSITION, DIRECTION (all but its turn about its own axis) or POSE.
    """

    def __init__(self, arm: Arm, kind: int = POSITION) -> None:
        if kind not in (POSITION, DIRECTION, POSE):
            raise InvalidValueError("kind", kind, "POSITION, DIRECTION or POSE")
        self.arm = arm
        self.kind = kind
        self._table = arm_table(arm)
        self._arrays = arm_arrays(arm)
        self._weight = radian_in_metres(arm)

    def rate(
        self, w: ArrayLike, velocity: ArrayLike, spin: ArrayLike = (0.0, 0.0, 0.0), wish: ArrayLike | None = None
    ) -> TipRate:
        """Rate at ``w`` (n_sections, 2) [rad] that moves the tip by ``velocity`` (3,) [m/s] and ``spin`` (3,) [rad/s].

        ``wish`` (n_sections, 2) [rad/s] is followed where the tip's velocity leaves the arm free.

        Raises:
            InvalidValueError: wrong shape or not finite.
        """
        w = finite("w", w, (self.arm.n_sections, 2))
        rate, moved, held = run_tip_rate(
            self._table,
            self.kind,
            self._weight,
            w.reshape(-1),
            finite("velocity", velocity, (3,)),
            finite("spin", spin, (3,)),
            (np.zeros(w.size) if wish is None else finite("wish", wish, w.shape).reshape(-1)),
        )
        return TipRate(rate.reshape(w.shape), moved[:3], moved[3:], held)

    def advance(self, w: Array, rate: Array, dt: float) -> Array:
        """Configuration (n_sections, 2) [rad] after ``rate`` [rad/s] for ``dt`` [s], no section beyond its limit."""
        moved = (w + dt * rate).reshape(-1)
        pull_within.py_func(self._arrays, moved)
        return moved.reshape(-1, 2)


def least_bending(w: Array, gain: float) -> Array:
    """Rate (n_sections, 2) [rad/s] down the gradient of |w|^2 / 2, for a gain [1/s]: the arm unbends where it may."""
    return -gain * np.asarray(w)

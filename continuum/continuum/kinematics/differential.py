"""Differential inverse kinematics of an arm: rates of its configurations for a velocity of the tip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.kinematics.chain import arm_jacobian
from continuum.kinematics.compiled.arm_arrays import arm_arrays, arm_table
from continuum.kinematics.compiled.limits import AT_LIMIT, pull_within
from continuum.kinematics.compiled.rate import run_tip_rate
from continuum.kinematics.compiled.task import radian_in_metres
from continuum.kinematics.configuration import bend
from continuum.kinematics.ik_settings import checked_arm
from continuum.kinematics.ik_target import DIRECTION, POSE, POSITION
from continuum.kinematics.section import configuration_from_point_jacobian, section_position
from continuum.number_checks import finite_number, finite_of_shape

_NEAR_BASE = 0.02  # part of a section's length within which its tip is too near to the base for Eq. 22

__all__ = ["DIRECTION", "POSE", "POSITION", "DifferentialKinematics", "TipRate", "least_bending"]


@dataclass(frozen=True)
class TipRate:
    """Rates of the configurations, and the tip velocity that they cause.

    Attributes:
        rate: rate of the configuration (n_sections, 2) [rad/s].
        velocity: velocity of the tip (3,) [m/s]; differs from the requested one near singular postures and at bend
            limits.
        spin: angular velocity of the tip (3,) [rad/s].
        held: whether a section was held at its bend limit instead of bending further.
    """

    rate: Array
    velocity: Array
    spin: Array
    held: bool


class DifferentialKinematics:
    """Differential kinematics of one arm.

    Args:
        arm: the arm.
        kind: components of the tip's velocity that are controlled: POSITION, DIRECTION (all but the rotation about the
            tip's z axis) or POSE.
    """

    def __init__(self, arm: Arm, kind: int = POSITION) -> None:
        if kind not in (POSITION, DIRECTION, POSE):
            raise InvalidValueError("kind", kind, "POSITION, DIRECTION or POSE")
        self.arm = checked_arm(arm)
        self.kind = kind
        self._table = arm_table(arm)
        self._arrays = arm_arrays(arm)
        self._weight = radian_in_metres(arm)

    def rate(
        self,
        w: ArrayLike,
        velocity: ArrayLike,
        spin: ArrayLike = (0.0, 0.0, 0.0),
        wish: ArrayLike | None = None,
        ahead: float = 0.0,
    ) -> TipRate:
        """Return the rate at ``w`` (n_sections, 2) [rad] for a tip ``velocity`` (3,) [m/s] and ``spin`` (3,) [rad/s].

        ``wish`` (n_sections, 2) [rad/s] is projected onto the null space of the task. A section that would reach its
        bend limit within ``ahead`` [s] is held as if it were at the limit.

        Raises:
            InvalidValueError: wrong shape or not finite.
        """
        w = finite_of_shape("w", w, (self.arm.n_sections, 2))
        velocity, spin = finite_of_shape("velocity", velocity, (3,)), finite_of_shape("spin", spin, (3,))
        free = np.zeros(w.size) if wish is None else finite_of_shape("wish", wish, w.shape).reshape(-1)
        if self.arm.n_sections == 1 and self.kind == POSITION:
            return self._by_eq_22(w, velocity, ahead)
        rate, moved, held = run_tip_rate(
            self._table, self.kind, self._weight, w.reshape(-1), velocity, spin, free, ahead
        )
        return TipRate(rate.reshape(w.shape), moved[:3], moved[3:], held)

    def _by_eq_22(self, w: Array, velocity: Array, ahead: float) -> TipRate:
        """Apply Eq. 22 to an arm of one section, which has no redundancy.

        Only the velocity component across the line from the base to the tip has an effect. The rate is damped near the
        posture in which the tip returns to the base.
        """
        section, jacobian = self.arm.sections[0], arm_jacobian(w, self.arm)
        tip = section_position(w[0], section)
        turned = np.cos(section.twist) * velocity + np.sin(section.twist) * np.array([velocity[1], -velocity[0], 0.0])
        turned[2] = velocity[2]
        distance = float(np.linalg.norm(tip))
        shortfall = max(_NEAR_BASE * section.length - distance, 0.0)
        with np.errstate(all="ignore"):
            rate = configuration_from_point_jacobian(tip) @ turned * distance**2 / (distance**2 + shortfall**2)
        rate = np.where(np.isfinite(rate), rate, 0.0)  # straight down, where the azimuth is not defined
        theta = float(bend(w[0]))
        outward = float(rate @ w[0])
        held = outward > 0.0 and theta**2 + ahead * outward >= theta * AT_LIMIT * section.bend_limit
        if held:
            rate = rate - outward / theta**2 * w[0]
        moved = jacobian @ rate
        return TipRate(rate[None], moved[:3], moved[3:], held)

    def advance(self, w: ArrayLike, rate: ArrayLike, dt: float) -> Array:
        """Return the configuration (n_sections, 2) [rad] after ``rate`` [rad/s] for ``dt`` [s], within the bend limits.

        Raises:
            InvalidValueError: wrong shape or not finite.
        """
        shape = (self.arm.n_sections, 2)
        w, rate = finite_of_shape("w", w, shape), finite_of_shape("rate", rate, shape)
        moved = (w + finite_number("dt", dt, "a finite number of seconds") * rate).reshape(-1)
        pull_within.py_func(self._arrays, moved)
        return moved.reshape(-1, 2)


def least_bending(w: Array, gain: float) -> Array:
    """Return the unbending rate (n_sections, 2) [rad/s], down the gradient of |w|^2 / 2 with a gain [1/s]."""
    return -gain * np.asarray(w)

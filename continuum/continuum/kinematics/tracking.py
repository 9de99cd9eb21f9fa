"""Track a moving target: solve every pose from the previous one, with consistent rates.

A redundant arm has many solutions for one pose. For consistent rates and configurations, both come from one
differential equation: the rate of :mod:`differential`, which uses the redundancy to unbend. Solving for the pose then
corrects the integration error by steps outside the null space.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.differential import DIRECTION, POSITION, DifferentialKinematics, TipRate, least_bending
from continuum.kinematics.ik_result import IkResult, IkStatus
from continuum.kinematics.ik_target import Target
from continuum.kinematics.inverse_kinematics import InverseKinematics
from continuum.number_checks import finite_number

_NO_SPIN = np.zeros(3)
_BEHIND = 1e-3  # largest velocity error that counts as following, as a fraction of the requested speed
_AT_REST = 1e-12  # [m/s], rounding
_RESTARTS = 64  # of a search from a known configuration that does not continue a motion
_RESTARTS_IN_MOTION = 16  # a pose out of reach takes about a millisecond; the next one tries the next postures
_N_TURNS = 16  # until the first postures are tried again
_SHIFT = 1e-4  # displacement of a target for the rate of the nearest posture, as a fraction of the arm's length


@dataclass(frozen=True)
class Tracked:
    """Answer to one target: the solution, and its rate (n_sections, 2) [rad/s] or None if no velocity was given."""

    result: IkResult
    rate: Array | None


class Tracker:
    """Track poses or twists of the tip.

    Args:
        arm: the arm.
        use_direction: whether to track the direction of the tip's z axis as well as the position.
        tolerance: largest distance [m], and largest angle [rad], that counts as solved.
        unbend_gain: gain of the unbending motion in the null space [1/s].

    Attributes:
        configuration: the current configuration (n_sections, 2) [rad]; initially straight.
    """

    def __init__(
        self, arm: Arm, use_direction: bool = False, tolerance: float = 1e-9, unbend_gain: float = 5.0
    ) -> None:
        self.use_direction = use_direction
        self.unbend_gain = unbend_gain
        self.configuration = np.zeros((arm.n_sections, 2))
        self._arm = arm
        self._differential = DifferentialKinematics(arm, DIRECTION if use_direction else POSITION)
        self._begin = InverseKinematics(arm, tolerance, objective="least_bending")
        self._stay = InverseKinematics(arm, tolerance, objective="near_start", n_restarts=_RESTARTS)
        self._continue = [
            InverseKinematics(arm, tolerance, "first", _RESTARTS_IN_MOTION, skip=turn * _RESTARTS_IN_MOTION)
            for turn in range(_N_TURNS)
        ]
        self._nearest = InverseKinematics(arm, tolerance, "near_start", n_restarts=0)
        self._n_out_of_reach = 0  # poses since the last one that was reached
        self._rates: list[Array] = []  # of the last instants, newest last; empty without a motion to continue

    def pose(
        self,
        position: Array,
        direction: Array | None = None,
        velocity: Array | None = None,
        angular_velocity: Array | None = None,
        dt: float | None = None,
    ) -> Tracked:
        """Solve for a pose of the tip, and for its velocity if it is known.

        Args:
            position: (3,) [m] in ``base_link``.
            direction: direction of the tip's z axis (3,); ignored unless ``use_direction``.
            velocity: velocity of the target (3,) [m/s]; None returns no rate. If the target is out of reach, the rate
                is that of the nearest posture.
            angular_velocity: angular velocity of the target's direction (3,) [rad/s].
            dt: time since the previous pose [s]; None if this pose does not continue it.

        Raises:
            InvalidValueError: the target is malformed.
        """
        target = Target(position, direction if self.use_direction else None)
        result = self._solve(target, dt)
        self.configuration = result.configuration
        if velocity is None:
            self._rates = []
            return Tracked(result, None)
        if not result.solved:
            self._rates = []
            return Tracked(result, self._rate_of_nearest(target, velocity, angular_velocity))
        rate = self._rate_within_limits(velocity, angular_velocity, 0.0 if dt is None else dt).rate
        self._rates = [*self._rates[-1:], rate]
        return Tracked(result, rate)

    def twist(self, velocity: Array, angular_velocity: Array | None, dt: float) -> Tracked:
        """Move the tip by a twist, (3,) [m/s] and (3,) [rad/s], for ``dt`` [s] (midpoint rule).

        If the arm cannot follow, at a bend limit or stretched out, the status reports it. The distance is the
        distance by which the tip falls behind in this step.

        Raises:
            InvalidValueError: an argument is not finite or has the wrong shape.
        """
        start, dt = self.configuration, finite_number("dt", dt, "a finite number of seconds")
        first = self._rate(velocity, angular_velocity)
        self.configuration = self._differential.advance(start, first.rate, 0.5 * dt)
        middle = self._rate(velocity, angular_velocity)
        reaches_limit = middle.held and not first.held  # the first rate goes all the way to the limit
        self.configuration = self._differential.advance(start, (first if reaches_limit else middle).rate, dt)
        self._rates = []
        now = self._rate(velocity, angular_velocity)
        behind = float(np.linalg.norm(now.velocity - velocity))
        status = IkStatus.SOLVED
        if behind > _BEHIND * np.linalg.norm(velocity) + _AT_REST:
            status = IkStatus.LIMIT_REACHED if now.held else IkStatus.UNREACHABLE
        return Tracked(IkResult(self.configuration, status, 0, behind * dt, 0.0), now.rate)

    def _solve(self, target: Target, dt: float | None) -> IkResult:
        result = self._continued(target, dt) if dt is not None else None
        if result is None:
            straight = not np.any(self.configuration)
            result = self._begin.solve(target) if straight else self._stay.solve(target, self.configuration)
        self._n_out_of_reach = 0 if result.solved else self._n_out_of_reach + 1
        return result

    def _continued(self, target: Target, dt: float) -> IkResult | None:
        """Return the solution that continues the motion; None if there is no motion."""
        if not self._rates and self._n_out_of_reach == 0:
            return None
        predicted = self._predict(dt) if self._rates else self.configuration
        result = self._continue[self._n_out_of_reach % _N_TURNS].solve(target, predicted)
        if not result.solved:
            self._rates = []
        return result

    def _predict(self, dt: float) -> Array:
        """Predict the configuration after ``dt`` [s] from the last two rates (Adams-Bashforth, second order)."""
        newest = self._rates[-1]
        derivative = 0.5 * (newest - self._rates[-2]) if len(self._rates) > 1 else 0.0
        return self.configuration + dt * (newest + derivative)

    def _rate_of_nearest(self, target: Target, velocity: Array, angular_velocity: Array | None) -> Array:
        """Return the rate of the posture nearest to a moving target out of reach, by a central difference."""
        spin = _NO_SPIN if angular_velocity is None or target.direction is None else np.asarray(angular_velocity)
        speed = float(np.linalg.norm(velocity)) + self._arm.length * float(np.linalg.norm(spin))
        if speed == 0.0:
            return np.zeros_like(self.configuration)
        dt = _SHIFT * self._arm.length / speed
        ahead, behind = (
            self._nearest.solve(_moved(target, side * dt, velocity, spin), self.configuration).configuration
            for side in (1, -1)
        )
        return (ahead - behind) / (2 * dt)

    def _rate_within_limits(self, velocity: Array, angular_velocity: Array | None, dt: float) -> TipRate:
        """Return the rate that holds sections about to reach a limit within ``dt`` [s], if the tip still follows."""
        held = self._rate(velocity, angular_velocity, dt)
        free = self._rate(velocity, angular_velocity) if held.held else held
        lacks = np.linalg.norm(held.velocity - free.velocity)
        if self.use_direction:  # the rotation about the tip's z axis is free
            axis = arm_pose(self.configuration, self._arm)[:3, 2]
            lacks += self._arm.length * np.linalg.norm(np.cross(held.spin - free.spin, axis))
        return held if lacks <= _BEHIND * np.linalg.norm(velocity) + _AT_REST else free

    def _rate(self, velocity: Array, angular_velocity: Array | None, ahead: float = 0.0) -> TipRate:
        w = self.configuration
        spin = _NO_SPIN if angular_velocity is None else angular_velocity
        return self._differential.rate(w, velocity, spin, least_bending(w, self.unbend_gain), ahead)


def _moved(target: Target, dt: float, velocity: Array, spin: Array) -> Target:
    """Return the target after ``dt`` [s] at a velocity (3,) [m/s] and an angular velocity (3,) [rad/s]."""
    direction = None if target.direction is None else target.direction + dt * np.cross(spin, target.direction)
    return Target(target.position + dt * np.asarray(velocity), direction)

"""Following a moving target: every pose solved from the one before it, with rates that belong to it.

A redundant arm has many answers for one pose. So that the published rates and the published configurations belong
together, both come from one differential equation: the rate of :mod:`differential`, with the redundancy used to unbend.
Poses then correct what integration has lost, by steps that leave the null space alone.
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
_BEHIND = 1e-3  # part of the wanted velocity that the tip may lack and still count as following
_AT_REST = 1e-12  # [m/s], rounding
_RESTARTS = 64  # of a search that a moving arm waits for
_RESTARTS_IN_MOTION = 16  # so that a pose out of reach takes about a millisecond; the next one tries the next postures
_N_TURNS = 16  # until the first postures are tried again
_SHIFT = 1e-4  # part of the arm's length by which a target is moved for the rate of the nearest posture


@dataclass(frozen=True)
class Tracked:
    """Answer to one target: the solution, and its rate (n_sections, 2) [rad/s], or None where no velocity was given."""

    result: IkResult
    rate: Array | None


class Tracker:
    """Follows poses or twists of the tip.

    Args:
        arm: the arm.
        use_direction: follow the direction of the tip's z axis too, not the position alone.
        tolerance: largest distance [m], and largest angle [rad], that counts as solved.
        unbend_gain: how fast the redundancy is used to bend less [1/s].

    Attributes:
        configuration: the present configuration (n_sections, 2) [rad]; straight at first.
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
        self._rates: list[Array] = []  # of the last instants, newest last; empty where no motion is continued

    def pose(
        self,
        position: Array,
        direction: Array | None = None,
        velocity: Array | None = None,
        angular_velocity: Array | None = None,
        dt: float | None = None,
    ) -> Tracked:
        """Answer a pose of the tip, and its velocity if it is known.

        Args:
            position: (3,) [m] in ``base_link``.
            direction: (3,), of the tip's z axis; ignored unless ``use_direction``.
            velocity: (3,) [m/s] of the target; without it, no rate is told. Where the target is out of reach, the rate
                is that of the nearest posture.
            angular_velocity: (3,) [rad/s] of the target, for its direction.
            dt: time since the pose before [s]; None where this pose does not continue it.

        Raises:
            InvalidValueError: malformed target.
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

        Where the arm cannot follow, at a bend limit or stretched out, the status says so; the distance is what the tip
        falls behind by this step.

        Raises:
            InvalidValueError: what is given is not finite or of another shape.
        """
        start, dt = self.configuration, finite_number("dt", dt, "a finite number of seconds")
        first = self._rate(velocity, angular_velocity)
        self.configuration = self._differential.advance(start, first.rate, 0.5 * dt)
        middle = self._rate(velocity, angular_velocity)
        reaches_limit = middle.held and not first.held  # go all the way to it, not to where the middle is not held
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
        """The answer that continues the motion; None where there is no motion."""
        if not self._rates and self._n_out_of_reach == 0:
            return None
        predicted = self._predict(dt) if self._rates else self.configuration
        result = self._continue[self._n_out_of_reach % _N_TURNS].solve(target, predicted)
        if not result.solved:
            self._rates = []
        return result

    def _predict(self, dt: float) -> Array:
        """Configuration after ``dt`` [s] from the last two rates (Adams and Bashforth, second order)."""
        newest = self._rates[-1]
        derivative = 0.5 * (newest - self._rates[-2]) if len(self._rates) > 1 else 0.0
        return self.configuration + dt * (newest + derivative)

    def _rate_of_nearest(self, target: Target, velocity: Array, angular_velocity: Array | None) -> Array:
        """How the posture nearest to a target out of reach moves with it: central difference of two such postures."""
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
        """The rate that holds sections which would reach their limits within ``dt`` [s], where the tip follows so."""
        held = self._rate(velocity, angular_velocity, dt)
        free = self._rate(velocity, angular_velocity) if held.held else held
        lacks = np.linalg.norm(held.velocity - free.velocity)
        if self.use_direction:  # a turn about the tip's own axis is free
            axis = arm_pose(self.configuration, self._arm)[:3, 2]
            lacks += self._arm.length * np.linalg.norm(np.cross(held.spin - free.spin, axis))
        return held if lacks <= _BEHIND * np.linalg.norm(velocity) + _AT_REST else free

    def _rate(self, velocity: Array, angular_velocity: Array | None, ahead: float = 0.0) -> TipRate:
        w = self.configuration
        spin = _NO_SPIN if angular_velocity is None else angular_velocity
        return self._differential.rate(w, velocity, spin, least_bending(w, self.unbend_gain), ahead)


def _moved(target: Target, dt: float, velocity: Array, spin: Array) -> Target:
    """A target after ``dt`` [s] at a velocity (3,) [m/s] and a spin (3,) [rad/s]."""
    direction = None if target.direction is None else target.direction + dt * np.cross(spin, target.direction)
    return Target(target.position + dt * np.asarray(velocity), direction)

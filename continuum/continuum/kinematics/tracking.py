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
from continuum.kinematics.bend_limits import within_limits
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.differential import configuration_rate, least_bending
from continuum.kinematics.gauss_newton import refine
from continuum.kinematics.ik_result import IkResult, IkStatus, Target
from continuum.kinematics.inverse_kinematics import solve
from continuum.kinematics.nearest_pose import nearest_pose
from continuum.kinematics.tip_task import TipTask

_UNBEND_STEPS = 200
_UNBEND_STEP = 0.2
_SEARCH_EVERY = 50  # poses out of reach, after which other answers are looked for again
_UNBENT = 1e-7  # change of a coordinate that ends the unbending [rad]


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
        self, arm: Arm, use_direction: bool = False, tolerance: float = 1e-6, unbend_gain: float = 5.0
    ) -> None:
        self.arm = arm
        self.use_direction = use_direction
        self.tolerance = tolerance
        self.unbend_gain = unbend_gain
        self.configuration = np.zeros((arm.n_sections, 2))
        self._rates: list[Array] = []  # of the last instants, newest last; empty before the first pose
        self._n_out_of_reach = 0  # poses since the last one that was reached

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
            velocity: (3,) [m/s] of the tip; without it, no rate is told.
            angular_velocity: (3,) [rad/s] of the tip, for its direction.
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
        rate = self._rate(np.asarray(velocity), angular_velocity)
        self._rates = [*self._rates[-1:], rate]
        return Tracked(result, rate)

    def twist(self, velocity: Array, angular_velocity: Array | None, dt: float) -> Tracked:
        """Move the tip by a twist, (3,) [m/s] and (3,) [rad/s], for ``dt`` [s] (midpoint rule)."""
        start = self.configuration
        middle_rate = self._rate(np.asarray(velocity), angular_velocity)
        self.configuration = within_limits(start + 0.5 * dt * middle_rate, self.arm)
        middle_rate = self._rate(np.asarray(velocity), angular_velocity)
        self.configuration = within_limits(start + dt * middle_rate, self.arm)
        rate = self._rate(np.asarray(velocity), angular_velocity)
        self._rates = []
        return Tracked(IkResult(self.configuration, IkStatus.SOLVED, 0, 0.0, 0.0), rate)

    def _solve(self, target: Target, dt: float | None) -> IkResult:
        result = self._continue(target, dt) if dt is not None else None
        if result is None:
            self._rates = []
            result = solve(self.arm, target.position, target.direction, self.configuration, self.tolerance)
            if result.solved and dt is None:
                result = self._unbend(target, result)
        self._n_out_of_reach = 0 if result.solved else self._n_out_of_reach + 1
        return result

    def _continue(self, target: Target, dt: float) -> IkResult | None:
        """The answer next to the one before; None where only a new search can help."""
        if self._n_out_of_reach % _SEARCH_EVERY:
            return nearest_pose(self.arm, target, self.configuration, self.tolerance)
        if self._n_out_of_reach or not self._rates:
            return None
        result = refine(self.arm, target, self._predict(dt), self.tolerance, max_iterations=15)
        return result if result.solved else None

    def _predict(self, dt: float) -> Array:
        """Configuration after ``dt`` [s] from the last two rates (Adams and Bashforth, second order)."""
        newest = self._rates[-1]
        slope = 0.5 * (newest - self._rates[-2]) if len(self._rates) > 1 else 0.0
        return self.configuration + dt * (newest + slope)

    def _unbend(self, target: Target, result: IkResult) -> IkResult:
        """Of the answers to one pose, the one near ``result`` that bends least."""
        task = TipTask(self.arm, target)
        for _ in range(_UNBEND_STEPS):
            w = result.configuration
            jacobian = task.jacobian(w)
            step = configuration_rate(jacobian, np.zeros(len(jacobian)), w, self.arm, least_bending(w, _UNBEND_STEP))
            moved = refine(self.arm, target, w + step, self.tolerance, max_iterations=15)
            if not moved.solved or np.max(np.abs(moved.configuration - w)) < _UNBENT:
                break
            result = moved
        return result

    def _rate(self, velocity: Array, angular_velocity: Array | None) -> Array:
        w = self.configuration
        geometric = arm_jacobian(w, self.arm)
        wish = least_bending(w, self.unbend_gain)
        if not self.use_direction or angular_velocity is None:
            return configuration_rate(geometric[:3], velocity, w, self.arm, wish)
        # Turning about the tip's own axis changes no direction, and the arm cannot do it: the task leaves it out.
        axis = arm_pose(w, self.arm)[:3, 2]
        task = TipTask(self.arm, Target(np.zeros(3), axis))
        task_velocity = np.concatenate([velocity, task.weight * np.cross(angular_velocity, axis)])
        return configuration_rate(task.jacobian(w), task_velocity, w, self.arm, wish)

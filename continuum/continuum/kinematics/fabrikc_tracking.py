"""Following a moving target by FABRIKc, the thesis's algorithm, from the configuration before."""

from __future__ import annotations

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.fabrikc import solve_fabrikc
from continuum.kinematics.ik_result import IkResult
from continuum.kinematics.ik_settings import checked_count
from continuum.kinematics.ik_target import Target
from continuum.kinematics.tracking import Tracker


class FabrikcTracker(Tracker):
    """Answers as those of `Tracker`, by FABRIKc alone: no restarts, no search for the nearest pose.

    Every pose is solved from the configuration before it, moved on by the last rates. Rates are those of the Jacobian;
    where FABRIKc ends away from the target, they move the tip as the target moves.

    Args:
        arm: the arm.
        use_direction: follow the direction of the tip's z axis too, not the position alone.
        tolerance: largest distance [m], and largest angle [rad], that counts as solved.
        max_iterations: pairs of a backward and a forward pass.
    """

    def __init__(
        self, arm: Arm, use_direction: bool = False, tolerance: float = 1e-6, max_iterations: int = 100
    ) -> None:
        super().__init__(arm, use_direction, tolerance)
        self._tolerance, self._max_iterations = tolerance, checked_count("max_iterations", max_iterations)

    def _solve(self, target: Target, dt: float | None) -> IkResult:
        start = self._predict(dt) if dt is not None and self._rates else self.configuration
        return solve_fabrikc(self._arm, target.position, target.direction, start, self._tolerance, self._max_iterations)

    def _rate_of_nearest(self, _target: Target, velocity: Array, angular_velocity: Array | None) -> Array:
        return self._rate_within_limits(velocity, angular_velocity, 0.0).rate

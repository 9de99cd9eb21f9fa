"""Track a moving target by FABRIKc, the thesis's algorithm, from the previous configuration."""

from __future__ import annotations

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.fabrikc import solve_fabrikc
from continuum.kinematics.ik_result import IkResult
from continuum.kinematics.ik_settings import checked_count
from continuum.kinematics.ik_target import Target
from continuum.kinematics.tracking import Tracker


class FabrikcTracker(Tracker):
    """A `Tracker` that uses FABRIKc alone, without restarts or a search for the nearest pose.

    Every pose is solved from the previous configuration, extrapolated with the last rates. The rates come from the
    Jacobian; where FABRIKc ends away from the target, they move the tip at the target's velocity.

    Args:
        arm: the arm.
        use_direction: whether to track the direction of the tip's z axis as well as the position.
        tolerance: largest distance [m], and largest angle [rad], that counts as solved.
        max_iterations: largest number of pairs of a backward and a forward pass.
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

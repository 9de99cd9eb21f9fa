"""A path as a function of time (KDL: Trajectory_Segment, with Trajectory_Stationary before and after it)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from trajectory_generator.checked_arrays import LARGEST, positive
from trajectory_generator.path import Path
from trajectory_generator.rotation import quaternions
from trajectory_generator.speed_profile import Trapezoid

MOST_INSTANTS = 10_000_000
"""Largest number of instants that are computed at once."""


@dataclass(frozen=True, eq=False)
class TrajectorySample:
    """Pose and twist at the requested instants, all in the base frame.

    Attributes:
        position: (..., 3) [m].
        quaternion: orientation x, y, z, w (..., 4), w >= 0.
        linear_velocity: (..., 3) [m/s].
        angular_velocity: (..., 3) [rad/s].
    """

    position: Array
    quaternion: Array
    linear_velocity: Array
    angular_velocity: Array


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Rest at the start of a path, one motion along it, rest at its end.

    The limits apply along the path: the speed is at most ``max_speed`` and its rate at most ``max_acceleration``; in an
    arc of radius r there is an additional acceleration v^2 / r across the path.

    Attributes:
        path: the path.
        max_speed: [m/s].
        max_acceleration: [m/s2].
        lead_time: rest before the motion [s].
        rest_time: rest after it [s].

    Raises:
        InvalidValueError: a value is out of its range.
    """

    path: Path
    max_speed: float
    max_acceleration: float
    lead_time: float = 0.0
    rest_time: float = 0.0

    def __post_init__(self) -> None:
        for name, value in (("lead_time", self.lead_time), ("rest_time", self.rest_time)):
            if not 0 <= value <= LARGEST:
                raise InvalidValueError(name, value, f"a number from 0 to {LARGEST:g} s")
        self.profile  # noqa: B018  (computed here so that bad limits are refused here)

    @cached_property
    def profile(self) -> Trapezoid:
        """Speed profile of the motion along the path, which starts at the end of the lead time."""
        return Trapezoid(self.path.length, self.max_speed, self.max_acceleration)

    @property
    def duration(self) -> float:
        """Time from the start of the lead time to the end of the rest time [s]."""
        return self.lead_time + self.profile.duration + self.rest_time

    def times(self, rate: float) -> Array:
        """Return the instants 0, 1 / rate, 2 / rate, ... (n,) [s], the last of them at or just after the end.

        Args:
            rate: instants per second [Hz].

        Raises:
            InvalidValueError: the rate is not a positive number, or gives more than ``MOST_INSTANTS``.
        """
        intervals = math.ceil(self.duration * positive("rate", rate, "Hz"))
        if intervals >= MOST_INSTANTS:
            raise InvalidValueError("rate", rate, f"less than {MOST_INSTANTS} instants in {self.duration:g} s")
        return np.arange(intervals + 1) / rate

    def sample(self, t: ArrayLike) -> TrajectorySample:
        """Return pose and twist at ``t`` (...) [s] since the start of the lead time; outside, those at rest."""
        since_lead = np.asarray(t, dtype=float) - self.lead_time
        s, s_dot = self.profile.position(since_lead), self.profile.velocity(since_lead)
        position, rotation = self.path.pose(s)
        linear, angular = self.path.twist(s, s_dot)
        return TrajectorySample(position, quaternions(rotation), linear, angular)

"""Speed in the form of a trapezium: even acceleration, cruise, even braking (KDL: VelocityProfile_Trap)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from trajectory_generator.checked_arrays import LARGEST, positive


@dataclass(frozen=True)
class Trapezoid:
    """Motion from 0 to ``distance`` from rest to rest, in the shortest time that both limits leave.

    A distance too short for the full speed, distance < v^2 / a, makes a triangle.

    Attributes:
        distance: way [m], not negative.
        max_speed: v [m/s].
        max_acceleration: a, of speeding up and of braking [m/s2].

    Raises:
        InvalidValueError: a value is out of its range.
    """

    distance: float
    max_speed: float
    max_acceleration: float

    def __post_init__(self) -> None:
        positive("max_speed", self.max_speed, "m/s")
        positive("max_acceleration", self.max_acceleration, "m/s2")
        # A path of many pieces may be longer than any single figure given from outside.
        if not 0 <= self.distance <= LARGEST**2:
            raise InvalidValueError("distance", self.distance, f"a number from 0 to {LARGEST**2:g} m")

    @property
    def ramp_time(self) -> float:
        """Time of speeding up, and of braking [s]: min(v / a, sqrt(distance / a))."""
        return min(self.max_speed / self.max_acceleration, math.sqrt(self.distance / self.max_acceleration))

    @property
    def cruise_time(self) -> float:
        """Time at full speed [s]: distance / v - v / a, or none."""
        return max(0.0, self.distance / self.max_speed - self.max_speed / self.max_acceleration)

    @property
    def duration(self) -> float:
        """Time of the whole motion [s]."""
        return 2 * self.ramp_time + self.cruise_time

    def position(self, t: Array) -> Array:
        """Way gone at ``t`` (...) [s] since the start (...) [m]; 0 before it, ``distance`` after the end."""
        t = np.clip(t, 0.0, self.duration)
        # Braking is speeding up seen from the end; the nearer end is the more exact one to count from.
        to_end = self.duration - t
        nearer = np.minimum(t, to_end)
        ramp = np.minimum(nearer, self.ramp_time)
        gone = self.max_acceleration * ramp * (nearer - ramp / 2)
        return np.where(t <= to_end, gone, self.distance - gone)

    def velocity(self, t: Array) -> Array:
        """Speed at ``t`` (...) [s] since the start (...) [m/s]; 0 outside the motion."""
        nearer = np.clip(np.minimum(t, self.duration - t), 0.0, self.ramp_time)
        return self.max_acceleration * nearer

    def acceleration(self, t: Array) -> Array:
        """Acceleration at ``t`` (...) [s] since the start (...) [m/s2]; at a step, the value after it."""
        t = np.asarray(t)
        speeding_up = (t >= 0) & (t < self.ramp_time)
        braking = (self.ramp_time + self.cruise_time <= t) & (t <= self.duration)
        sign: Array = speeding_up.astype(float) - braking.astype(float)
        return self.max_acceleration * sign

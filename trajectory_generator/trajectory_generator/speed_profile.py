"""Trapezoidal speed profile: constant acceleration, cruise, constant deceleration (KDL: VelocityProfile_Trap)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from trajectory_generator.checked_arrays import LARGEST, positive


@dataclass(frozen=True)
class Trapezoid:
    """Motion from 0 to ``distance``, from rest to rest, in the shortest time that both limits allow.

    For a distance too short for the full speed, distance < v^2 / a, the profile is a triangle.

    Attributes:
        distance: path length [m], not negative.
        max_speed: v [m/s].
        max_acceleration: a, for acceleration and deceleration [m/s2].

    Raises:
        InvalidValueError: a value is out of its range.
    """

    distance: float
    max_speed: float
    max_acceleration: float

    def __post_init__(self) -> None:
        positive("max_speed", self.max_speed, "m/s")
        positive("max_acceleration", self.max_acceleration, "m/s2")
        # A path of many pieces may exceed the limit of a single number from outside.
        if not 0 <= self.distance <= LARGEST**2:
            raise InvalidValueError("distance", self.distance, f"a number from 0 to {LARGEST**2:g} m")

    @property
    def ramp_time(self) -> float:
        """Duration of the acceleration, and of the deceleration [s]: min(v / a, sqrt(distance / a))."""
        return min(self.max_speed / self.max_acceleration, math.sqrt(self.distance / self.max_acceleration))

    @property
    def cruise_time(self) -> float:
        """Time at full speed [s]: distance / v - v / a, or 0."""
        return max(0.0, self.distance / self.max_speed - self.max_speed / self.max_acceleration)

    @property
    def duration(self) -> float:
        """Duration of the whole motion [s]."""
        return 2 * self.ramp_time + self.cruise_time

    def position(self, t: Array) -> Array:
        """Return the distance (...) [m] at ``t`` (...) [s] since the start; 0 before it, ``distance`` after the end."""
        t = np.clip(t, 0.0, self.duration)
        # Deceleration is acceleration in reverse; counting from the nearer end is more accurate.
        to_end = self.duration - t
        nearer = np.minimum(t, to_end)
        ramp = np.minimum(nearer, self.ramp_time)
        gone = self.max_acceleration * ramp * (nearer - ramp / 2)
        return np.where(t <= to_end, gone, self.distance - gone)

    def velocity(self, t: Array) -> Array:
        """Return the speed (...) [m/s] at ``t`` (...) [s] since the start; 0 outside the motion."""
        nearer = np.clip(np.minimum(t, self.duration - t), 0.0, self.ramp_time)
        return self.max_acceleration * nearer

    def acceleration(self, t: Array) -> Array:
        """Return the acceleration (...) [m/s2] at ``t`` (...) [s] since the start; at a step, the value after it."""
        t = np.asarray(t)
        speeding_up = (t >= 0) & (t < self.ramp_time)
        braking = (self.ramp_time + self.cruise_time <= t) & (t <= self.duration)
        sign: Array = speeding_up.astype(float) - braking.astype(float)
        return self.max_acceleration * sign

"""A sensor shows a motion too large or too small: (1 + gain) theta and (1 + gain) w.

Gain and misalignment are one parameter: a gyro whose axis leans by m from the joint's shows cos(m) of the rate, and the
angle summed up from it, cos(m) of the angle, which nothing in a plane tells from a gain of cos(m) - 1. So gain < 0 may
mean either (18 degrees for -0.05). What a sensor turned within the plane does is `angle_offset`.

Gyros are within 1 to 3 % from the factory.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from continuum.dynamics.effect import Effect, Own
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.reading import Reading


class SensorScale(Effect):
    """Gain of the sensors."""

    name = "sensor_scale"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "gain": Parameter("e_s", "1", -0.5, 0.5, True, "measured motion of a joint by the true one, less 1", 0.0, 0.05)
    }
    source = "Tedaldi, Pretto and Menegatti, IEEE ICRA 2014 (calibration of inertial sensors)"
    in_words = "A sensor shows too much or too little of the motion, or sits askew on its disc."
    looks_like = "Measured and simulated motion have one shape and time but not one size, angle and rate alike."
    experiment = "Turn the joint by a known angle, against a stop, and compare."

    def measure(self, seen: Reading, own: Own) -> Reading:
        return Reading(seen.times, (1 + own["gain"]) * seen.theta, (1 + own["gain"]) * seen.theta_rate)

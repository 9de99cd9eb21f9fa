"""A link's sensor shows a motion too large or too small: (1 + gain) times the link's angle and rate.

Joints are differences of neighbouring sensors, the first one against the base plate: with Theta_i the links' angles,
joint i is read as (1 + e_i) Theta_i - (1 + e_i-1) Theta_i-1, and one wrong sensor spoils the joints on both sides.

Gain and misalignment are one parameter: a gyro whose axis leans by m from the joints' shows cos(m) of the rate, and the
angle summed up from it, cos(m) of the angle, which nothing in a plane tells from a gain of cos(m) - 1. So gain < 0 may
mean either (18 degrees for -0.05). What a sensor turned within the plane does is `angle_offset`.

Gyros are within 1 to 3 % from the factory.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import ByHand, Parameter
from continuum.dynamics.trajectory import Reading


class SensorScale(Effect):
    """Gain of the sensors."""

    name = "sensor_scale"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "gain": Parameter(
            "e_s",
            "1",
            -0.5,
            0.5,
            True,
            "measured motion of a link by the true one, less 1",
            0.0,
            0.05,
            by_hand=ByHand(
                0.01, "Turn the link by 90 degrees against a stop: what the sensor shows over that, less 1."
            ),
        )
    }
    source = "Tedaldi, Pretto and Menegatti, IEEE ICRA 2014 (calibration of inertial sensors)"
    in_words = "A sensor reports too much or too little of its link's motion, or is misaligned on its disc."
    symptom = "The joints on both sides of a sensor err in opposite ways, in proportion to how far its link is turned."
    experiment = "Turn the link by a known angle, against a stop, and compare."
    beware = "Links that are longer or shorter than in the model look nearly the same: measure their lengths as well."

    def measure(self, seen: Reading, params: EffectParams) -> Reading:
        def spoiled(joints: Array) -> Array:
            wrong = params["gain"] * np.cumsum(joints, axis=1)
            return np.asarray(joints + np.diff(wrong, axis=1, prepend=0.0))

        return replace(seen, theta=spoiled(seen.theta), theta_rate=spoiled(seen.theta_rate))

"""The sensor of a link reads a scaled motion: (1 + gain) times the angle and rate of the link.

Joint angles are differences of neighbouring sensors, the first one relative to the base plate: with link angles
Theta_i, the reading of joint i is (1 + e_i) Theta_i - (1 + e_i-1) Theta_i-1, and one wrong sensor affects the joints on
both sides.

Gain and misalignment are one parameter: a gyro whose axis is inclined by m to those of the joints reads cos(m) of the
rate, and the integrated angle is cos(m) of the angle, which in a plane is equivalent to a gain of cos(m) - 1. A
negative gain may therefore mean either (18 degrees for -0.05). `angle_offset` describes a sensor rotated within the
plane.

Factory calibration of gyros is accurate to 1 to 3 %.
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
            "measured motion of a link relative to the true one, minus 1",
            0.0,
            0.05,
            by_hand=ByHand(
                0.01, "Turn the link by 90 degrees against a stop: the reading divided by 90 degrees, minus 1."
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

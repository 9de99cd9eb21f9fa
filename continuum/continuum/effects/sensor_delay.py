"""Delayed sensors: theta(t - delay) and its rate at all joints, or a further lag at one joint.

In Eq. 12 only the cable tensions depend explicitly on time. Late sensors are therefore equivalent to tensions that come
later by the same time, u(t - delay), and without tensions a delay cannot be detected. Filters and radio links take 5 to
30 ms; at 3 rad/s, 10 ms are 1.7 degrees.

If the angle of one joint lags behind those of the others, they show it without any input. To first order its reading is
theta - lag theta'; the remainder, lag^2 theta'' / 2, is 0.3 degrees for 10 ms at 100 rad/s2. Negative lags are
excluded: one early joint is equivalent to a delay of all others, which cannot be detected in an arm that nothing
drives.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import ByHand, Parameter
from continuum.dynamics.trajectory import Reading


class SensorDelay(Effect):
    """Delay of the sensors."""

    name = "sensor_delay"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "delay": Parameter(
            "t_d",
            "s",
            0.0,
            0.2,
            False,
            "delay of all sensors",
            0.0,
            0.01,
            by_hand=ByHand(
                0.003, "Tap the arm and compare the sensors' answer with that of a contact on the same clock."
            ),
        ),
        "lag": Parameter("t_j", "s", 0.0, 0.1, True, "lag of a joint's angle behind those of the others", 0.0, 0.01),
    }
    needs_tension = True
    shifts_time = True
    source = "Nilsson and Handel, IEEE/ION PLANS 2010 (time synchronisation of sensor measurements)"
    in_words = "The sensors report late, or the motors get their commands late by as much: data cannot separate these."
    beware = (
        "Commands that reach the motors a fixed time late look exactly the same: step the command with the arm held "
        "still and record the tension at the base of the cable."
    )
    symptom = "All joints follow the model, shifted by the same time; the error grows with speed."
    experiment = (
        "Film the release with a lamp that the recording switches on, or tap the arm and compare with a contact."
    )

    def late(self, params: EffectParams) -> Numbers:
        return params["delay"]

    def measure(self, seen: Reading, params: EffectParams) -> Reading:
        return replace(seen, theta=seen.theta - params["lag"] * seen.theta_rate)

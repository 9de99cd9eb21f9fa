"""All sensors show what was a little while ago: theta(t - delay), and its rate.

Between samples the motion is the cubic of angles and rates at both (Hermite); its slope is the rate. Before the first
sample it goes on straight; parts of a recording are simulated from 50 ms before their first sample. Filters and radio
links take 5 to 30 ms; at 3 rad/s 10 ms are 1.7 degrees.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from continuum.dynamics.effect import Effect, Own
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.reading import Reading

_LONGEST = 0.2  # s


class SensorDelay(Effect):
    """Late sensors."""

    name = "sensor_delay"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "delay": Parameter("t_d", "s", 0.0, _LONGEST, False, "by which all sensors are late", 0.0, 0.01)
    }
    source = "Nilsson and Handel, IEEE/ION PLANS 2010 (time synchronisation of sensor measurements)"
    in_words = "The sensors report late."
    looks_like = "All joints follow the model, shifted by the same time, and the more wrong the faster they move."
    experiment = (
        "Film the release with a lamp that the recording switches on, or tap the arm and compare with a contact."
    )
    looks_back = 0.05

    def measure(self, seen: Reading, own: Own) -> Reading:
        times = np.append(seen.times[0] - 2 * _LONGEST, seen.times)  # straight on backwards
        theta = np.concatenate([seen.theta[:1] - 2 * _LONGEST * seen.theta_rate[:1], seen.theta])
        motion = CubicHermiteSpline(times, theta, np.concatenate([seen.theta_rate[:1], seen.theta_rate]))
        then = seen.times - own["delay"]
        return replace(seen, theta=motion(then), theta_rate=motion(then, 1))

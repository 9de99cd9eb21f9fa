"""A gyro reads a rate at rest, and the integrated angle drifts: w + bias, theta + bias (t - t_0).

Each joint has a separate value in every recording. The bias of a MEMS gyroscope is about 0.1 to 1 degree/s after each
start; the bias of a joint combines those of two sensors. 0.02 rad/s cause 1.8 degrees after 1.6 s.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.trajectory import Reading


class GyroDrift(Effect):
    """Bias of the gyros."""

    name = "gyro_drift"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "bias": Parameter("b_w", "rad/s", -1.0, 1.0, True, "measured rate of a joint at rest", 0.0, 0.02, True)
    }
    source = "Woodman, An introduction to inertial navigation, UCAM-CL-TR-696, 2007, sec. 3.2"
    in_words = "A gyro drifts: the angle of a joint at rest keeps changing."
    symptom = "The gap between measured and simulated angles grows in proportion to time, even while the arm rests."
    experiment = "Record the arm at rest for half a minute before and after each release."

    def measure(self, seen: Reading, params: EffectParams) -> Reading:
        passed = (seen.times - seen.begun)[:, None]
        return replace(seen, theta=seen.theta + params["bias"] * passed, theta_rate=seen.theta_rate + params["bias"])

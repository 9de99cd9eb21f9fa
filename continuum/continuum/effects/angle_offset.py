"""The angle of a sensor has a constant error, separate for each recording: theta + offset.

It depends on how the sensor is mounted on its disc and on its zero at power-on, and amounts to some degrees.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import ByHand, Parameter
from continuum.dynamics.trajectory import Reading


class AngleOffset(Effect):
    """Error of the zeros of the angle sensors."""

    name = "angle_offset"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "offset": Parameter(
            "o",
            "rad",
            -1.0,
            1.0,
            True,
            "added to a joint's measured angle",
            0.0,
            0.03,
            True,
            by_hand=ByHand(
                0.005, "Read the resting angle on a protractor: the reading of the sensor minus this angle."
            ),
        )
    }
    source = "Woodman, An introduction to inertial navigation, UCAM-CL-TR-696, 2007, sec. 3 and 4"
    in_words = "A sensor has a wrong zero: its angle is off by a constant amount from the start."
    symptom = (
        "Measured and simulated angles differ by a constant and their rates agree; the offset differs between runs."
    )
    experiment = "Measure the resting angle with a protractor, or restart the sensors and release again."
    beware = (
        "A spring whose rest angle changes from run to run looks nearly the same: measure the resting "
        "angles another way."
    )

    def measure(self, seen: Reading, params: EffectParams) -> Reading:
        return replace(seen, theta=seen.theta + params["offset"])

"""What is recorded as a cable's pull is not what pulls: T = u / (1 + gain), for each cable by itself.

With one gain for both cables, all torques of Eq. 12 but the cables' are as much too small: nothing in the motion tells
that from links that are all as much heavier, with stiffness and friction in proportion.

Load cells hold their calibration to 1 % or better; one mounted where the cable pulls it askew, or scaled by the wrong
amplifier's factor, is soon 10 % off.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import ByHand, Parameter


class TensionScale(Effect):
    """Gain of the load cells, or of the motors that are told how much to pull."""

    name = "tension_scale"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "gain_1": Parameter(
            "e_1",
            "1",
            -0.5,
            2.0,
            False,
            "pull of cable 1 as recorded by the true one, less 1",
            0.0,
            0.1,
            by_hand=ByHand(0.02, "Hang a known weight on cable 1: what is recorded over its weight, less 1."),
        ),
        "gain_2": Parameter(
            "e_2",
            "1",
            -0.5,
            2.0,
            False,
            "pull of cable 2 as recorded by the true one, less 1",
            0.0,
            0.1,
            by_hand=ByHand(0.02, "Hang a known weight on cable 2: what is recorded over its weight, less 1."),
        ),
    }
    uses_cables = True
    needs_tension = True
    source = (
        "Beckwith, Marangoni and Lienhard, Mechanical Measurements, 2007, ch. 13 (calibration of force transducers)"
    )
    in_words = "The recorded cable tension is too large or too small by a constant factor."
    symptom = (
        "Under tension the arm bends too far or not far enough, in proportion; released, it swings as in the model."
    )
    experiment = "Hang a known weight from each cable's end and compare what is recorded; weigh the links."
    beware = (
        "Cable holes nearer to or farther from the axis than in the model look the same, and links of another "
        "length nearly so: measure both."
    )

    def pull(self, u: Numbers, params: EffectParams, state: Numbers) -> Numbers:
        return u / (1 + np.concatenate([params["gain_1"], params["gain_2"]]))

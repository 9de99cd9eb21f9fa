"""The recorded tension of a cable differs from the true one by a factor: T = u / (1 + gain), separately for each cable.

With one gain for both cables, all torques of Eq. 12 except those of the cables are wrong by the same factor: the motion
does not distinguish this from links that are all heavier in the same ratio, with proportional stiffness and friction.

Load cells keep their calibration to 1 % or better. A cell mounted at an angle to its cable, or scaled by the factor of
another amplifier, easily has an error of 10 %.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import ByHand, Parameter


class TensionScale(Effect):
    """Gain of the load cells, or of motors that are commanded in tension."""

    name = "tension_scale"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "gain_1": Parameter(
            "e_1",
            "1",
            -0.5,
            2.0,
            False,
            "recorded tension of cable 1 relative to the true one, minus 1",
            0.0,
            0.1,
            by_hand=ByHand(
                0.02, "Hang a known weight on cable 1: the recorded tension divided by the weight, minus 1."
            ),
        ),
        "gain_2": Parameter(
            "e_2",
            "1",
            -0.5,
            2.0,
            False,
            "recorded tension of cable 2 relative to the true one, minus 1",
            0.0,
            0.1,
            by_hand=ByHand(
                0.02, "Hang a known weight on cable 2: the recorded tension divided by the weight, minus 1."
            ),
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

"""The arm hangs at another angle than in the model: beta + angle.

A 1 mm shim under one edge of a 30 mm plate tilts it by 2 degrees. On an arm of 1.1 kg, whose weight has a moment of 1.1
N m about joint 1 when the arm is horizontal, this adds a torque of 0.04 N m at joint 1, as large as its dry friction.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import ByHand, Parameter, Parameters


class BaseTilt(Effect):
    """Error of beta in the gravity term of Eq. 12."""

    name = "base_tilt"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "angle": Parameter(
            "beta_e",
            "rad",
            -1.0,
            1.0,
            False,
            "added to the hang angle",
            0.0,
            0.035,
            by_hand=ByHand(
                0.005,
                "Put a spirit level on the base plate: its tilt in the arm's plane beyond the model file's hang angle.",
            ),
        )
    }
    source = "thesis Eq. 12, G; Khalil and Dombre, Modeling, Identification and Control of Robots, 2002, ch. 9"
    in_words = "The base plate is not level, so the arm hangs at an angle."
    symptom = "All joints come to rest to one side, most of all those near the base, which carry the most weight."
    experiment = (
        "Put a spirit level on the base plate; or turn the arm half a turn about its own axis and release again: "
        "a tilt then changes sign in the arm's joint angles."
    )

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        return replace(p, hang_angle=p.hang_angle + params["angle"])

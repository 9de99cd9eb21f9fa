"""Springs that are relaxed at another angle than in the model: K (theta - theta_0 - angle).

theta_0 of Eq. 12 is 0 for a joint that is straight when relaxed. Discs glued at an angle, or a spring once bent beyond
its limit, shift it by a few degrees; 0.05 rad change the torque of a spring of 1.24 N m/rad by 0.06 N m, more than the
dry friction of 0.04 N m holds.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import ByHand, Parameter, Parameters


class RestAngle(Effect):
    """Errors of theta_0 in Eq. 12."""

    name = "rest_angle"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "angle": Parameter(
            "theta_0",
            "rad",
            -1.0,
            1.0,
            True,
            "added to the angle of a joint's relaxed spring",
            0.0,
            0.05,
            by_hand=ByHand(
                0.01,
                "Lay the arm on its side on a smooth table, cables slack, and read the joint's angle on a protractor.",
            ),
        )
    }
    source = "thesis Eq. 12; Budynas and Nisbett, Shigley's Mechanical Engineering Design, ch. 10 (set of springs)"
    in_words = "The spring of a joint is relaxed at a bent angle, not straight."
    symptom = "The joint comes to rest off its expected angle by a constant amount, from both sides and at any load."
    experiment = (
        "Turn the whole arm half a turn about its axis and release it again: a rest angle turns with the arm, "
        "a tilt of the base does not; a sensor's offset changes with every start of the sensor."
    )

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        return replace(p, rest_angle=p.rest_angle + params["angle"])

"""Springs whose stiffness differs between joints: K (1 + excess).

The rate of a coil spring is proportional to the fourth power of the wire diameter, so 5 % of diameter are 20 % of
stiffness.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import Parameter, Parameters


class JointStiffness(Effect):
    """Errors of K in Eq. 12 at single joints."""

    name = "joint_stiffness"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "excess": Parameter(
            "e_K",
            "1",
            -0.95,
            20.0,
            True,
            "stiffness of a joint relative to the model's, minus 1",
            0.0,
            0.2,
            ordinary=0.02,
        )
    }
    source = "thesis Eq. 12; Budynas and Nisbett, Shigley's Mechanical Engineering Design, ch. 10 (rate of a spring)"
    in_words = "The spring of a joint is stiffer or softer than those of the others."
    in_words_if_more = "The spring of a joint is stiffer than those of the others."
    in_words_if_less = "The spring of a joint is softer than those of the others."
    symptom = "Under the same load the joint bends less, or more, than its neighbours, in proportion to the load."
    experiment = "Hang known weights on the tip of the arm held level and read the angle of each joint at rest."
    beware = (
        "A spring that creeps is stiffer in fast motions than in slow ones: hold the joint bent and watch its torque."
    )

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        return replace(p, stiffness=p.stiffness * (1 + params["excess"]))

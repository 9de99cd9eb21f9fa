"""Cables rub on the discs more than the model has it: mu_c + friction in Eqs. 14 and 15.

Cable in a drilled or bushed hole: 0.1 to 0.3. At 0.1 a cable that turns by 1 rad through the arm loses a tenth. The
law itself is `continuum.dynamics.planar.capstan_law.tension_propagation`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import ByHand, Parameter, Parameters


class Capstan(Effect):
    """mu_c of Eqs. 14 and 15."""

    name = "capstan"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "friction": Parameter(
            "mu_e",
            "1",
            0.0,
            2.0,
            False,
            "added to the friction of cables on discs",
            0.0,
            0.1,
            ordinary=0.02,
            by_hand=ByHand(
                0.03,
                "Pull the cable over a disc at a known angle with a force gauge at either end: the logarithm of the "
                "ratio of their forces over that angle, less the model file's friction.",
            ),
        )
    }
    uses_cables = True
    needs_tension = True
    source = "thesis Eqs. 14 and 15; Kaneko, Yamashita and Tanie, ICAR 1991 (transmission of tendon drives)"
    in_words = "The cables rub in the holes of the discs, so less tension reaches the tip."
    symptom = (
        "Under tension the joints near the tip bend less than those near the base, increasingly so as the arm bends."
    )
    experiment = "Pull slowly and let go slowly: at the same tension the bend differs, most of all at the tip."

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        return replace(p, capstan_friction=p.capstan_friction + params["friction"])

"""Cables have more friction on the discs than in the model: mu_c + friction in Eqs. 14 and 15.

The friction coefficient of a cable in a drilled or bushed hole is 0.1 to 0.3. At 0.1, a cable that is deflected by 1
rad in total loses a tenth of its tension. The capstan law is in
`continuum.dynamics.planar.capstan_law.tension_propagation`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import ByHand, Parameter, Parameters


class Capstan(Effect):
    """Additional mu_c in Eqs. 14 and 15."""

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
                "ratio of their forces divided by that angle, minus the friction in the model file.",
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

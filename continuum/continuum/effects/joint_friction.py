"""Joints with more or less friction than the others: tau_mu (1 + viscous) and tau_c (1 + coulomb).

There are two parameters because grease and fit differ between joints independently. The friction of equal joints of one
machine commonly differs by tens of percent.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import Parameter, Parameters


class JointFriction(Effect):
    """Errors of tau_mu and tau_c in Eq. 13 at single joints."""

    name = "joint_friction"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "viscous": Parameter(
            "e_mu", "1", -1.0, 20.0, True, "viscous friction relative to the model's, minus 1", 0.0, 0.5, ordinary=0.05
        ),
        "coulomb": Parameter(
            "e_c", "1", -1.0, 20.0, True, "Coulomb friction relative to the model's, minus 1", 0.0, 0.5, ordinary=0.03
        ),
    }
    source = "thesis Eq. 13; Armstrong-Helouvry, Dupont and Canudas de Wit, Automatica 30, 1994, 1083-1138"
    in_words = "A joint is tighter or looser than the others: it needs grease, or has lost its preload."
    in_words_if_more = "A joint has more friction than the others: it needs grease, or is clamped too tight."
    in_words_if_less = "A joint has less friction than the others: it has lost its preload."
    in_words_if_lacking = "The joints have friction, and the model has none."
    symptom = "The joint's motion dies out sooner or later than its neighbours', and the joint sticks at another angle."
    experiment = "Move each joint alone by hand at a steady speed, both ways, with a force gauge."

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        return replace(
            p,
            viscous_friction=p.viscous_friction * (1 + params["viscous"]),
            coulomb_friction=p.coulomb_friction * (1 + params["coulomb"]),
        )

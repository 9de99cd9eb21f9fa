"""Links that differ in mass from the model: m (1 + mass), and I_z (1 + inertia) about the centre of mass.

The thesis itself suspects this deficit of its model. Drawings give masses without glue, screws, cables and connectors,
and moments of inertia of uniform bodies: errors of 10 % in mass and of half of the inertia occur easily.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import ByHand, Parameter, Parameters


class Inertia(Effect):
    """Errors of m and I_z in Eq. 12."""

    name = "inertia"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "mass": Parameter(
            "e_m",
            "1",
            -0.9,
            10.0,
            True,
            "mass of a link relative to the model's, minus 1",
            0.0,
            0.1,
            ordinary=0.01,
            by_hand=ByHand(0.01, "Weigh the link alone: its mass divided by that in the model file, minus 1."),
        ),
        "inertia": Parameter(
            "e_I",
            "1",
            -0.95,
            50.0,
            True,
            "inertia of a link about its centre of mass, relative to the model's, minus 1",
            0.0,
            0.5,
            ordinary=0.03,
        ),
    }
    # mass added at the centre, mass added at about one and a half radii of gyration, and mass only moved outwards
    directions: ClassVar[Sequence[Mapping[str, float]]] = [
        {"mass": 1.0},
        {"mass": 1.0, "inertia": 2.0},
        {"inertia": 1.0},
    ]
    source = "thesis, discussion of Fig. 9; Atkeson, An and Hollerbach, Int. J. Robotics Research 5(3), 1986, 101-119"
    in_words = "A link is heavier or lighter than in the drawings, or its mass is distributed differently."
    in_words_if_more = "A link is heavier than in the drawings, or its mass lies further out."
    in_words_if_less = "A link is lighter than in the drawings, or its mass lies further in."
    symptom = "Swings are slower and gravity pulls the joint further, in proportion; or both the other way."
    experiment = "Weigh each link by itself; add a known weight to one, release again and compare."
    beware = "Links that are longer or shorter than in the model look nearly the same: measure their lengths as well."

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        return replace(p, mass=p.mass * (1 + params["mass"]), inertia=p.inertia * (1 + params["inertia"]))

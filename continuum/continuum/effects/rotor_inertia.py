"""Rotor inertia of a drive that the model lacks: J_r + ratio (I_z + m c^2), reflected to the joint.

A rotor turns faster than its joint by the gear ratio, and its inertia at the joint is multiplied by the square of that
ratio: a rotor of 0.6 kg cm2 behind a gear of 6:1 is 0.002 kg m2 at the joint, as much as many light links. Its size is
relative to the inertia of the link about its joint, so that a value means the same on small and large arms.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import ByHand, Parameter, Parameters


class RotorInertia(Effect):
    """Error of J_r in the mass matrix M of Eq. 12."""

    name = "rotor_inertia"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "ratio": Parameter(
            "e_J",
            "1",
            0.0,
            100.0,
            True,
            "missing inertia of a drive relative to that of its link",
            0.0,
            0.3,
            by_hand=ByHand(
                0.05,
                "Take the rotor's inertia from the drive's data sheet, multiply it by the square of the gear ratio, "
                "subtract the rotor inertia in the model file, and divide by the link's inertia about its joint.",
            ),
        )
    }
    source = "Armstrong, Khatib and Burdick, IEEE ICRA 1986, 510-518 (drives' inertia of the PUMA 560)"
    in_words = "The rotor of a joint's drive adds inertia that the model lacks."
    symptom = (
        "A joint accelerates and decelerates more slowly, whatever the other joints do, but its weight is unchanged."
    )
    experiment = "Swing the outer link alone, its drive disengaged and engaged, and compare the periods."
    beware = (
        "At the first joint a rotor and a larger inertia of the link look the same: consult the drive's data sheet."
    )
    uses_drives = True

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        of_link = p.inertia + p.mass * p.center_of_mass**2
        return replace(p, rotor_inertia=p.rotor_inertia + params["ratio"] * of_link)

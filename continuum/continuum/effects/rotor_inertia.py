"""A drive's rotor that the model lacks: J_r + ratio (I_z + m c^2), reflected to the joint.

A rotor turns faster than its joint by the gear ratio and counts with its square: a rotor of 0.6 kg cm2 behind a gear of
6:1 is 0.002 kg m2 at the joint, as much as many a light link. Its size is given as a part of the link's inertia about
its own joint, so that it means the same on a small and on a large arm.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.parameters import ByHand, Parameter, Parameters


class RotorInertia(Effect):
    """J_r in M of Eq. 12."""

    name = "rotor_inertia"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "ratio": Parameter(
            "e_J",
            "1",
            0.0,
            100.0,
            True,
            "missing inertia of a drive over its link's",
            0.0,
            0.3,
            by_hand=ByHand(
                0.05,
                "Take the rotor's inertia from the drive's data sheet, times the gear ratio squared, over the link's"
                " inertia about its joint, less what the model file has.",
            ),
        )
    }
    source = "Armstrong, Khatib and Burdick, IEEE ICRA 1986, 510-518 (drives' inertia of the PUMA 560)"
    in_words = "The rotor of a joint's drive adds inertia that the model lacks."
    symptom = "A joint speeds up and brakes more slowly, whatever the other joints do, but weighs no more."
    experiment = "Swing the outer link alone, its drive disengaged and engaged, and compare the periods."
    beware = (
        "At the first joint a rotor and a larger inertia of the link look the same: consult the drive's data sheet."
    )
    uses_drives = True

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        of_link = p.inertia + p.mass * p.center_of_mass**2
        return replace(p, rotor_inertia=p.rotor_inertia + params["ratio"] * of_link)

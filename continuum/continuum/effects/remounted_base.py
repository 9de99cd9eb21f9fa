"""The base was remounted before every run, each time with another tilt: beta + angle.

The repeatability of a clamp without a pin is one or two degrees; 2 degrees on an arm of 1.1 kg change the torque at
joint 1 by 0.04 N m, as much as its dry friction.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from continuum.dynamics.parameters import Parameter
from continuum.effects.base_tilt import BaseTilt


class RemountedBase(BaseTilt):
    """Error of beta in the gravity term of Eq. 12, separate for every recording."""

    name = "remounted_base"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "angle": Parameter("beta_r", "rad", -1.0, 1.0, False, "added to the hang angle", 0.0, 0.035, True)
    }
    alike_in_all_runs = BaseTilt.name
    source = "thesis Eq. 12, G; Slocum, Precision Machine Design, 1992, ch. 7 (repeatability of mounts)"
    in_words = "The base plate is not level, and its tilt differs from run to run."
    symptom = "All joints come to rest to one side, most of all near the base; the side differs from run to run."
    experiment = "Pin the base plate, or put a spirit level on it before every run."

"""The base was remounted for every run, each time at another tilt: beta + angle.

A clamp without a pin repeats to a degree or two; 2 degrees turn an arm of 1.1 kg by 0.04 N m, its dry friction.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from continuum.dynamics.parameters import Parameter
from continuum.effects.base_tilt import BaseTilt


class RemountedBase(BaseTilt):
    """beta of Eq. 12's gravity, of its own in every recording."""

    name = "remounted_base"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "angle": Parameter("beta_r", "rad", -1.0, 1.0, False, "added to the hang angle", 0.0, 0.035, True)
    }
    alike_in_all_runs = BaseTilt.name
    source = "thesis Eq. 12, G; Slocum, Precision Machine Design, 1992, ch. 7 (repeatability of mounts)"
    in_words = "The base plate is not level, and its tilt differs from run to run."
    symptom = "All joints come to rest to one side, most of all near the base; the side differs from run to run."
    experiment = "Pin the base plate, or put a spirit level on it before every run."

"""A point mass M at the centre of the tip disc, b beyond the last joint; or at the end of the last link without discs.

The centre of mass c of the last link moves to c + (b - c) M / (m + M), and its inertia about the centre of mass
increases by m M / (m + M) (b - c)^2 (parallel axes). 50 g beyond five links of 220 g add 5 % to the weight and 9 % to
its moment about joint 1.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import ByHand, Parameter, Parameters


class TipPayload(Effect):
    """Additional mass on the last link."""

    name = "tip_payload"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "mass": Parameter(
            "M",
            "kg",
            0.0,
            10.0,
            False,
            "mass at the centre of the tip disc, or at the end of the last link if the arm has no discs",
            0.0,
            0.05,
            by_hand=ByHand(0.002, "Take off what hangs on the tip and weigh it."),
        )
    }
    source = "Atkeson, An and Hollerbach, Int. J. Robotics Research 5(3), 1986, 101-119 (loads)"
    in_words = "The tip carries a weight that the model lacks."
    symptom = "All joints swing more slowly and hang nearer to the vertical, most of all those near the base."
    experiment = "Take off what hangs on the tip, weigh it, and weigh the last link without it."

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        m, c, beyond = p.mass[-1:], p.center_of_mass[-1:], p.tip - p.center_of_mass[-1:]
        share = params["mass"] / (m + params["mass"])
        return replace(
            p,
            mass=_with_last(p.mass, m + params["mass"]),
            center_of_mass=_with_last(p.center_of_mass, c + beyond * share),
            inertia=_with_last(p.inertia, p.inertia[-1:] + m * share * beyond**2),
        )


def _with_last(values: Numbers, last: Numbers) -> Numbers:
    return np.concatenate([values[:-1], last])

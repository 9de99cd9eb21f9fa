"""A cable that is not pulled hangs loose, and pulls only when its motor has wound up what hangs: u exp(-(g / w)^2).

g is the way that is still to be wound up, between 0 and slack, L the cable's way through the arm. It grows and
shrinks with the arm and the motor, which winds up at a speed v where it is told more than u_0 and lets go where less,
and stops within w / 4 of both ends; within b u_0 of u_0 it does a little of either:

  g' = r,      r = -L' - v s,      s = tanh((u / u_0 - 1) / b),
  times tanh(4 (slack - g) / w) where r > 0, tanh(4 g / w) where r < 0.

Without slack g stays 0 and the cable pulls as it is told.

Lines that leave a pulley or sag between motor and base hang loose by some millimetres; geared motors wind up 0.1 to
1 m/s, so that 10 mm take 10 to 100 ms, and do nothing below the tension of their friction, some tenths of a newton.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers, positive_part, where_positive
from continuum.dynamics.parameters import Parameter, Parameters
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.dynamics.planar.instant import Instant
from continuum.effects._parts import lengthening_rate

_ENDS = 4.0  # ways from loose to taut are so much longer than the ends in which g stops


class SlackCable(Effect):
    """Slack between motors and arm."""

    name = "slack_cable"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "slack": Parameter("s", "m", 0.0, 0.2, False, "by which a cable that is not pulled hangs loose", 0.0, 0.01),
        "speed": Parameter("v", "m/s", 0.02, 5.0, False, "at which a motor winds up what hangs loose", 0.3, 0.2),
        "least": Parameter("u_0", "N", 0.01, 5.0, False, "tension below which a motor lets the cable hang", 0.3, 0.3),
        "blur": Parameter("b", "1", 0.04, 1.0, False, "part of u_0 around it in which a motor changes over", 0.1, 0.1),
        "taut": Parameter("w", "m", 5e-5, 1e-2, False, "way from loose to taut", 5e-4, 5e-4),
    }
    uses_cables = True
    needs_tension = True
    beginnings: ClassVar[Sequence[Mapping[str, float]]] = [
        {"slack": slack, "least": least} for slack in (0.005, 0.015) for least in (0.1, 0.3, 1.0, 3.0)
    ]
    source = "Agrawal, Peine and Yao, IEEE Trans. Robotics 26, 2010, 914-924 (slack of cables in conduits)"
    in_words = "The cables hang loose when not pulled, and pull only once the motor has wound up the slack."
    symptom = "When a cable begins to pull, nothing happens for a moment; cables that stay taut agree with the model."
    experiment = "Keep a few newtons on both cables all the time and repeat the motion, so that no slack forms."

    def n_states(self, n_joints: int) -> int:
        """g of each cable [m]."""
        return len(SIDES)

    def pull(self, u: Numbers, params: EffectParams, state: Numbers) -> Numbers:
        pulling = u * np.exp(-((state / params["taut"]) ** 2))
        return where_positive(-u, u, pulling)  # one that was let go is, however loose

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        winding = np.tanh((now.u / params["least"] - 1) / params["blur"])
        rate = -lengthening_rate(now.motion, now.p) - params["speed"] * winding
        until_loose, until_taut = params["slack"] - state, state
        loosening = positive_part(rate) * np.tanh(_ENDS * until_loose / params["taut"])
        tightening = positive_part(-rate) * np.tanh(_ENDS * until_taut / params["taut"])
        return state_rate - loosening + tightening

    def initial_state(self, theta: Array, u: Array, params: EffectParams, p: Parameters) -> Array:
        """Wound up where the motor pulls."""
        return np.asarray(np.where(u > params["least"], 0.0, params["slack"]))

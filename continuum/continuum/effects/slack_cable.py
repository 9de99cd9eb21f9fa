"""A cable that is not pulled becomes slack, and pulls only after its motor has wound in the slack: u exp(-(g / w)^2).

g is the slack that remains to be wound in, between 0 and ``slack``, and L is the length of the cable's path through the
arm. g changes with the motions of the arm and the motor. The motor winds in at speed v if the command exceeds u_0 and
pays out at v if it is lower. The transition has the half-width b u_0. The rate of g falls to zero within w / 4 of each
limit:

  g' = r,      r = -L' - v s,      s = tanh((u / u_0 - 1) / b),
  times tanh(4 (slack - g) / w) if r > 0, tanh(4 g / w) if r < 0.

At slack = 0, g stays 0 and the tension equals the command.

Lines that leave a pulley or sag between motor and base have some millimetres of slack. Geared motors wind in 0.1 to 1
m/s, so 10 mm take 10 to 100 ms; below the tension of their friction, some tenths of a newton, they do not move.
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

_ENDS = 4.0  # ratio of the travel from slack to taut to the range before each limit in which g stops


class SlackCable(Effect):
    """Slack between motors and arm."""

    name = "slack_cable"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "slack": Parameter("s", "m", 0.0, 0.2, False, "slack of a cable that is not pulled", 0.0, 0.01),
        "speed": Parameter("v", "m/s", 0.02, 5.0, False, "speed at which a motor winds in the slack", 0.3, 0.2),
        "least": Parameter("u_0", "N", 0.01, 5.0, False, "command below which a motor pays out the cable", 0.3, 0.3),
        "blur": Parameter("b", "1", 0.04, 1.0, False, "half-width of the transition at u_0, relative to u_0", 0.1, 0.1),
        "taut": Parameter("w", "m", 5e-5, 1e-2, False, "travel from slack to taut", 5e-4, 5e-4),
    }
    uses_cables = True
    needs_tension = True
    beginnings: ClassVar[Sequence[Mapping[str, float]]] = [
        {"slack": slack, "least": least} for slack in (0.005, 0.015) for least in (0.1, 0.3, 1.0, 3.0)
    ]
    source = "Agrawal, Peine and Yao, IEEE Trans. Robotics 26, 2010, 914-924 (slack of cables in conduits)"
    in_words = "The cables hang loose when not pulled, and pull only once the motor has wound up the slack."
    symptom = "When a cable starts to pull, the arm responds after a pause; with taut cables it agrees with the model."
    experiment = "Keep a few newtons on both cables all the time and repeat the motion, so that no slack forms."

    def n_states(self, n_joints: int) -> int:
        """g of each cable [m]."""
        return len(SIDES)

    def pull(self, u: Numbers, params: EffectParams, state: Numbers) -> Numbers:
        pulling = u * np.exp(-((state / params["taut"]) ** 2))
        return where_positive(-u, u, pulling)  # a released cable stays released, whatever its slack

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        winding = np.tanh((now.u / params["least"] - 1) / params["blur"])
        rate = -lengthening_rate(now.motion, now.p) - params["speed"] * winding
        until_slack, until_taut = params["slack"] - state, state
        loosening = positive_part(rate) * np.tanh(_ENDS * until_slack / params["taut"])
        tightening = positive_part(-rate) * np.tanh(_ENDS * until_taut / params["taut"])
        return state_rate - loosening + tightening

    def initial_state(self, theta: Array, u: Array, params: EffectParams, p: Parameters) -> Array:
        """Return g: 0 if the motor pulls, otherwise the full slack."""
        return np.asarray(np.where(u > params["least"], 0.0, params["slack"]))

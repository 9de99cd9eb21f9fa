"""A cable that is not pulled hangs loose, and pulls only when its motor has wound up what hangs: u exp(-g / 1 mm).

g is the way that is still to be wound up, between 0 and slack, L the cable's way through the arm. It grows and
shrinks with the arm and the motor, and stops within 1 mm of both ends:

  g' = r,      r = -L' - speed (2 d - 1),      d = u^2 / (u^2 + (0.1 N)^2): 1 where the motor is told to pull,
  times tanh((slack - g) / 1 mm) where r > 0, tanh(g / 1 mm) where r < 0.

Without slack g stays 0 and the cable pulls as it is told.

Lines that leave a pulley or sag between motor and base hang loose by some millimetres; geared motors wind up 0.1 to
1 m/s, so that 10 mm take 10 to 100 ms.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect, Own
from continuum.dynamics.expressions import Numbers, positive_part
from continuum.dynamics.parameters import Parameter, Parameters
from continuum.dynamics.planar.cables import SIDES
from continuum.dynamics.planar.instant import Instant
from continuum.effects.parts.cables import driven, lengthening_rate

_TAUT = 1e-3  # m: so near to an end the cable is nearly there


class SlackCable(Effect):
    """Slack between motors and arm."""

    name = "slack_cable"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "slack": Parameter("s", "m", 0.0, 0.2, False, "by which a cable that is not pulled hangs loose", 0.0, 0.01),
        "speed": Parameter("v", "m/s", 0.02, 5.0, False, "at which a motor winds up what hangs loose", 0.3, 0.2),
    }
    needs_tension = True
    source = "Agrawal, Peine and Yao, IEEE Trans. Robotics 26, 2010, 914-924 (slack of cables in conduits)"
    in_words = "The cables hang loose when they are not pulled, and pull only after the motor has wound that up."
    looks_like = "When a cable begins to pull nothing happens for a moment; cables that stay taut do as the model says."
    experiment = "Keep some newtons on both cables all the time and repeat the motion: slack then plays no part."

    def n_states(self, n_joints: int) -> int:
        """g of each cable [m]."""
        return len(SIDES)

    def pull(self, u: Numbers, own: Own, state: Numbers) -> Numbers:
        return u * np.exp(-state / _TAUT)

    def state_balance(self, now: Instant, own: Own, state: Numbers, state_rate: Numbers) -> Numbers:
        rate = -lengthening_rate(now.motion, now.p) - own["speed"] * (2 * driven(now.u) - 1)
        loosening, tightening = positive_part(rate), positive_part(-rate)
        return state_rate - loosening * np.tanh((own["slack"] - state) / _TAUT) + tightening * np.tanh(state / _TAUT)

    def initial_state(self, theta: Array, u: Array, own: Own, p: Parameters) -> Array:
        """Wound up where the motor pulls."""
        return np.asarray(np.where(2 * driven(u) > 1, 0.0, own["slack"]))

"""Stuck joints give way elastically before they slide: the LuGre model in the place of Eq. 13's smoothed sign.

With s = dry friction by tau_c, the state, h = 1 + S exp(-(w / v_d)^2), w the joint's rate and sigma the angle that
the contact bends by at tau_c,

  sigma s' = |w| (sgn w - s / h),      dry friction tau_c s instead of tau_c h tanh(k_v w).

|w| is rounded to w / tanh(k_v w), at least 1 / k_v, and sgn to tanh(k_v w): sliding steadily, s is just Eq. 13's.
So a stuck joint creeps as slowly as Eq. 13 lets it, and the friction takes energy only. sigma is never below 1e-5 rad,
which moves a release by 0.02 degrees (RMS); a ten times larger one by 0.08 degrees, so it is seen early.

Metals give way by some micrometres, 1e-4 rad at a small pin; plastics and rubber in the joint's spring by degrees.
0.02 rad hold back 0.04 N m as a spring of 2 N m/rad would, more than K = 1.24 N m/rad.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import Effect, Own
from continuum.dynamics.expressions import Numbers, smooth_sign
from continuum.dynamics.parameters import Parameter, Parameters
from continuum.dynamics.planar.eq13_joint_friction import dry_friction
from continuum.dynamics.planar.instant import Instant
from continuum.effects.parts.rounded import rounded_size

_LEAST_ANGLE = 1e-5  # rad: without any, the state would have no rate
_NEAR_ZERO = 1e-3  # of k_v w: x / tanh(x) is 0 / 0 at 0


class Presliding(Effect):
    """Dry friction with a memory."""

    name = "presliding"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "angle": Parameter("sigma", "rad", 0.0, 0.5, False, "by which a stuck joint gives way at tau_c", 0.0, 0.02)
    }
    source = "Canudas de Wit, Olsson, Astrom and Lischinsky, IEEE Trans. Automatic Control 40, 1995, 419-425"
    in_words = "Joints that stick still give way a little, like rubber, before they slide."
    looks_like = "Where the model sticks the joint rocks and springs back a little; small swings have hysteresis."
    experiment = "Push a resting joint gently to and fro, below its break-away force: it springs back to where it was."
    state_spread = 0.7

    def n_states(self, n_joints: int) -> int:
        """s of each joint [1]."""
        return n_joints

    def torque(self, now: Instant, own: Own, state: Numbers) -> Numbers:
        """The dry friction with memory less the one without, (n,) [N m]."""
        w, p = now.motion.theta_rate, now.p
        return p.coulomb_friction * state - dry_friction(w, p) * smooth_sign(w, p.friction_slope)

    def state_balance(self, now: Instant, own: Own, state: Numbers, state_rate: Numbers) -> Numbers:
        w, p = now.motion.theta_rate, now.p
        slid = rounded_size(p.friction_slope * w, _NEAR_ZERO)
        speed = slid / np.tanh(slid) / p.friction_slope
        missing = smooth_sign(w, p.friction_slope) - state / _stribeck(w, p)
        return (own["angle"] + _LEAST_ANGLE) * state_rate - speed * missing


def _stribeck(w: Numbers, p: Parameters) -> Numbers:
    """h, (n,) [1]: the dry friction of 1 N m."""
    return dry_friction(w, replace(p, coulomb_friction=np.ones(1)))

"""Stuck joints give way elastically before they slide: generalized Maxwell slip in the place of Eq. 13's smoothed sign.

Asperities bend and slip one after another. Three elements, each a spring in series with dry friction, stand for all.
Element j slips when it has bent by sigma_j h,

  sigma_j = sigma (1 + r (j - 2) 2 / 3),  j = 1, 2, 3,     h = 1 + S exp(-(w / v_d)^2),     w the joint's rate,

and holds the part sigma_j / (3 sigma) of the friction: before any slips they are one spring of tau_c / sigma. With the
states s_j, each the element's torque over that at which it slips at h = 1, and x_j = s_j / h,

  sigma_j s_j' = w - (|w| + w) / 2 P(x_j) + (|w| - w) / 2 P(-x_j),     P(x) = 101 x^32 / (100 + x^32), 0 below x = 0,

  dry friction tau_c sum_j (sigma_j s_j + t_b w b(x_j)) / (3 sigma) instead of tau_c h tanh(k_v w).

P rounds the corner at which an element begins to slip. While bent, b(x) = (1 - x^2)^2 where |x| < 1, else 0, an element
loses as its material does, t_b = 0.5 ms: without that, contacts much stiffer than those of plastics would ring as no
joint does. |w| is rounded to w / tanh(k_v w), so that a stuck joint creeps less than Eq. 13 lets it, and friction takes
energy only; sliding faster than 5 / k_v it is Eq. 13's. sigma is never below 1e-5 rad.

Unlike models of one state (Dahl, LuGre), elements remember where the joint turned: loops close, and a joint that turns
round gives way as the same spring again, as measured friction does (Swevers et al., IEEE Trans. Automatic Control 45,
2000). Asperities all alike (r = 0) are one spring before one friction; r = 1 are ones that slip evenly from the first
motion on to 2 sigma (Iwan, J. Applied Mechanics 33, 1966). Contacts have always some that slip early.

Metals give way by some micrometres, 1e-4 rad at a small pin; plastics and rubber in the joint's spring by degrees.
0.02 rad hold back 0.04 N m as a spring of 2 N m/rad would, more than K = 1.24 N m/rad.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers, positive_part, smooth_sign
from continuum.dynamics.parameters import Parameter, Parameters
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.planar.springs_and_friction import dry_friction
from continuum.effects._parts import rounded_size

_PLACES = np.array([[-2.0], [0.0], [2.0]]) / 3  # of the elements between -1 and 1, each amid its third
_SQUARED = 5  # times, of P
_FASTEST = 100.0  # about the most that P may be
_LEAST_ANGLE = 1e-5  # rad: without any, the states would have no rates
_LOSS_TIME = 5e-4  # t_b [s]
_NEAR_ZERO = 1e-3  # of k_v w: x / tanh(x) is 0 / 0 at 0


class Presliding(Effect):
    """Dry friction with a memory."""

    name = "presliding"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "angle": Parameter(
            "sigma", "rad", 0.0, 0.5, False, "by which a stuck joint gives way at tau_c", 0.0, 0.02, ordinary=0.002
        ),
        "spread": Parameter("r", "1", 0.4, 1.0, False, "how unlike each other asperities slip", 0.7, 0.1),
    }
    source = "Al-Bender, Lampaert and Swevers, IEEE Trans. Automatic Control 50, 2005, 1883-1887"
    in_words = "A joint that sticks yields a little, like rubber, before it slides."
    symptom = "Where the model sticks, the real joint rocks and springs back a little; small swings show hysteresis."
    experiment = "Push a resting joint gently to and fro, below its break-away force: it springs back to where it was."
    state_sd = 0.7
    within_friction = True

    def n_states(self, n_joints: int) -> int:
        """s of each joint's first element, then of the others [1]."""
        return _PLACES.size * n_joints

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        """The dry friction with memory less the one without, (n,) [N m]."""
        w, p = now.motion.slip_rate, now.p
        s = _by_element(state)
        bent = positive_part(1 - (s / _stribeck(w, p)) ** 2) ** 2
        lost = _LOSS_TIME * w * bent / (_PLACES.size * (params["angle"] + _LEAST_ANGLE))
        held = (_shares(params) * s + lost).sum(axis=0)
        return p.coulomb_friction * held - dry_friction(w, p) * smooth_sign(w, p.friction_slope)

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        w, p = now.motion.theta_rate, now.p
        slid = rounded_size(p.friction_slope * w, _NEAR_ZERO)
        speed = slid / np.tanh(slid) / p.friction_slope
        x = _by_element(state) / _stribeck(w, p)
        slip = (speed + w) / 2 * _slipping(x) - (speed - w) / 2 * _slipping(-x)
        angles = (params["angle"] + _LEAST_ANGLE) * _PLACES.size * _shares(params)
        return (angles * _by_element(state_rate) - w + slip).reshape(-1)


def _shares(params: EffectParams) -> Numbers:
    """sigma_j / (3 sigma), (3, 1) [1]."""
    return (1 + params["spread"] * _PLACES) / _PLACES.size


def _by_element(state: Numbers) -> Numbers:
    """One element's states in each row, (3, n) [1]."""
    return state.reshape(_PLACES.size, -1)


def _slipping(x: Numbers) -> Numbers:
    """P [1]."""
    power = positive_part(x)
    for _ in range(_SQUARED):
        power = power * power
    return (1 + _FASTEST) * power / (_FASTEST + power)


def _stribeck(w: Numbers, p: Parameters) -> Numbers:
    """h, (n,) [1]: the dry friction of 1 N m."""
    return dry_friction(w, replace(p, coulomb_friction=np.ones(1)))

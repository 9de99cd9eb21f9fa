"""Stuck joints yield elastically before they slide: generalized Maxwell slip instead of the smoothed sign of Eq. 13.

Asperities bend, then slip one after another. Three elements represent them, each a spring in series with dry friction.
Element j slips when it is bent by sigma_j h,

  sigma_j = sigma (1 + r (j - 2) 2 / 3),  j = 1, 2, 3,     h = 1 + S exp(-(w / v_d)^2),     w the joint rate,

and transmits the part sigma_j / (3 sigma) of the friction: before any of them slips, together they are one spring of
tau_c / sigma. The states s_j are the torque of each element relative to its slip torque at h = 1. With x_j = s_j / h,

  sigma_j s_j' = w - (|w| + w) / 2 P(x_j) + (|w| - w) / 2 P(-x_j),     P(x) = 101 x^32 / (100 + x^32), 0 below x = 0,
  dry friction tau_c sum_j (sigma_j s_j + t_b w b(x_j)) / (3 sigma) instead of tau_c h tanh(k_v w).

P rounds the corner at which an element starts to slip. A bent element has the damping of its material, t_b = 0.5 ms,
with b(x) = (1 - x^2)^2 for |x| < 1 and 0 otherwise: without it, contacts much stiffer than those of plastics would ring
as no real joint does. |w| is rounded to w / tanh(k_v w), so that a stuck joint creeps less than with Eq. 13 and
friction only dissipates energy; a joint faster than 5 / k_v has the friction of Eq. 13. sigma is at least 1e-5 rad.

Unlike models with one state (Dahl, LuGre), the elements remember where the joint reversed: hysteresis loops close, and
after each reversal the joint yields as the same spring again, as measured friction does (Swevers et al., IEEE Trans.
Automatic Control 45, 2000). Identical asperities (r = 0) act as one spring in series with one friction element. With r
= 1, they start to slip one after another, evenly from the first motion up to 2 sigma (Iwan, J. Applied Mechanics 33,
1966). In real contacts, some asperities always slip early.

Metals yield by some micrometres, 1e-4 rad at a small pin; plastics and rubber in series with the spring of the joint,
by degrees. 0.02 rad hold 0.04 N m like a spring of 2 N m/rad, more than K = 1.24 N m/rad.
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

_PLACES = (
    np.array([[-2.0], [0.0], [2.0]]) / 3
)  # positions of the elements between -1 and 1, each at the centre of a third
_SQUARED = 5  # number of squarings in P: x^32
_FASTEST = 100.0  # largest value of P, approximately
_LEAST_ANGLE = 1e-5  # rad; at zero the states would have no rates
_LOSS_TIME = 5e-4  # t_b [s]
_NEAR_ZERO = 1e-3  # rounding of k_v w: x / tanh(x) is 0 / 0 at 0


class Presliding(Effect):
    """Dry friction with a memory."""

    name = "presliding"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "angle": Parameter(
            "sigma", "rad", 0.0, 0.5, False, "angle by which a stuck joint yields at tau_c", 0.0, 0.02, ordinary=0.002
        ),
        "spread": Parameter(
            "r", "1", 0.4, 1.0, False, "relative range of the angles at which asperities slip", 0.7, 0.1
        ),
    }
    source = "Al-Bender, Lampaert and Swevers, IEEE Trans. Automatic Control 50, 2005, 1883-1887"
    in_words = "A joint that sticks yields a little, like rubber, before it slides."
    symptom = "A joint that sticks in the model rocks and springs back a little; small swings show hysteresis."
    experiment = "Push a resting joint gently to and fro, below its break-away force: it springs back to where it was."
    state_sd = 0.7
    within_friction = True

    def n_states(self, n_joints: int) -> int:
        """s of the first element of every joint, then of the second and third elements [1]."""
        return _PLACES.size * n_joints

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        """Return the dry friction with memory minus that of Eq. 13, which it replaces, (n,) [N m]."""
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
    """States with one element in each row, (3, n) [1]."""
    return state.reshape(_PLACES.size, -1)


def _slipping(x: Numbers) -> Numbers:
    """P [1]."""
    power = positive_part(x)
    for _ in range(_SQUARED):
        power = power * power
    return (1 + _FASTEST) * power / (_FASTEST + power)


def _stribeck(w: Numbers, p: Parameters) -> Numbers:
    """h, (n,) [1]: the dry friction at tau_c = 1 N m."""
    return dry_friction(w, replace(p, coulomb_friction=np.ones(1)))

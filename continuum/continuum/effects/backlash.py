"""Play of a joint in series with its spring and friction: the ball that they hold moves the link only by its stops.

The joint's angle theta is that of the ball, beta, and of the link in it, y = theta - beta, which is free within +- gap.
The stops are stiff springs k_s = 100 N m/rad with a damping of 1 ms, their corners rounded within 0.001 rad; ball
and ring are light, so their spring and friction (Eq. 13) balance the stops at any time:

  T = k_s (z(y) + 1 ms z'(y) y'),      z(y) = y - (r(y + gap) - r(y - gap)) / 2,      r(y) = sqrt(y^2 + width^2),
  T = K_b (beta - theta_0) + F(beta'),      K_b = K k_s / (k_s - K).

T takes the place of Eq. 12's spring and friction. K_b is such that without play spring and stops together are the
model's K.

Bolts of 5 mm in holes of 5.2 mm, 10 mm apart, have 0.02 rad each way; within them a link swings free of friction.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect, Own
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameter, Parameters
from continuum.dynamics.planar.eq12_spring_torque import spring_torque
from continuum.dynamics.planar.eq13_joint_friction import joint_friction
from continuum.dynamics.planar.instant import Instant
from continuum.effects.parts.rounded import rounded_size

_STOP = 100.0  # N m/rad: gives way by 0.02 degrees to the dry friction of 0.04 N m
_DAMPING = 1e-3  # s
_CORNER = 1e-3  # rad
_MOST_STEPS, _SOLVED = 60, 1e-15


class Backlash(Effect):
    """Clearance of joints."""

    name = "backlash"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "gap": Parameter("delta", "rad", 0.0, 0.5, True, "play of a joint to each side", 0.0, 0.02)
    }
    source = "Nordin and Gutman, Automatica 38, 2002, 1633-1649"
    in_words = "A joint has play: for a small way it moves without its spring and friction."
    looks_like = "The joint rattles freely within its play when the load on it changes sides, and knocks at its ends."
    experiment = "Move the resting joint by hand with a force gauge: within the play it meets nothing at all."
    state_spread = 0.02

    def n_states(self, n_joints: int) -> int:
        """beta of each joint [rad]."""
        return n_joints

    def torque(self, now: Instant, own: Own, state: Numbers, state_rate: Numbers) -> Numbers:
        """T in the place of spring and friction of Eq. 12, (n,) [N m]."""
        move, p = now.motion, now.p
        taken = spring_torque(move.theta, p) + joint_friction(move.theta_rate, p)
        return _stops(move.theta - state, move.theta_rate - state_rate, own) - taken

    def state_balance(self, now: Instant, own: Own, state: Numbers, state_rate: Numbers) -> Numbers:
        move, p = now.motion, now.p
        held = spring_torque(state, _of_ball(p)) + joint_friction(state_rate, p)
        return held - _stops(move.theta - state, move.theta_rate - state_rate, own)

    def initial_state(self, theta: Array, u: Array, own: Own, p: Parameters) -> Array:
        """The ball pulled against its stop by its spring, friction aside."""
        ball = _of_ball(p)
        low, high = np.minimum(theta, p.rest_angle) - 1e-12, np.maximum(theta, p.rest_angle) + 1e-12
        for _ in range(_MOST_STEPS):
            middle = (low + high) / 2
            beyond = spring_torque(middle, ball) > _stops(theta - middle, 0 * middle, own)
            low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
        return (low + high) / 2


def _of_ball(p: Parameters) -> Parameters:
    """The arm with K_b for K."""
    return replace(p, stiffness=p.stiffness * _STOP / (_STOP - p.stiffness))


def _stops(y: Numbers, y_rate: Numbers, own: Own) -> Numbers:
    """T, (n,) [N m]."""
    after, before = y + own["gap"], y - own["gap"]
    far, near = rounded_size(after, _CORNER), rounded_size(before, _CORNER)
    touching = 1 - (after / far - before / near) / 2
    return _STOP * (y - (far - near) / 2 + _DAMPING * touching * y_rate)

"""Backlash of a joint in series with its spring and friction: these hold a ball that moves the link only by its stops.

The joint angle theta is the sum of the angle of the ball, theta - y, and that of the link relative to it, y, which is
free within +- gap. The stops are springs of k_s = 3000 N m/rad + K with a damping of d = 10 N m s/rad; their corners
are rounded within 0.1 mrad. The ball with its ring has an inertia of J_b = 1e-6 kg m2. T replaces the spring torque of
Eq. 12 and the friction F of Eq. 13:

  T = k_s z + d z' dy/dt,     z(y) = y - (r(y + gap) - r(y - gap)) / 2,     z' = dz/dy,
  J_b dw/dt = T - K_b (theta - y - theta_0) - F(w),     w = d(theta - y)/dt,     r(y) = sqrt(y^2 + width^2).

K_b = K k_s / (k_s - K), so that without backlash the spring and the stops in series have the stiffness K. Stops and
ball then change a release by 0.01 degrees (RMS). Without inertia, the speed of the ball would have to be solved from F,
which changes abruptly with speed; solvers converge poorly on it.

5 mm bolts in 5.2 mm holes that are 10 mm apart have 0.02 rad to each side; within this range a link swings without
friction.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import ByHand, Parameter, Parameters
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.planar.springs_and_friction import break_away_torque, joint_friction, spring_torque
from continuum.effects._parts import rounded_size

_STOP = 3000.0  # N m/rad, more than K
_STOP_DAMPING = 10.0  # N m s/rad
_CORNER = 1e-4  # rad
_BALL = 1e-6  # kg m2
_NEWTON_STEPS = 12
_LEAST_VISCOUS = 1e-6  # N m s/rad, and N m/rad


class Backlash(Effect):
    """Clearance of joints."""

    name = "backlash"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "gap": Parameter(
            "delta",
            "rad",
            0.0,
            0.5,
            True,
            "backlash of a joint to each side",
            0.0,
            0.02,
            by_hand=ByHand(
                0.003,
                "Turn the resting joint to and fro by hand, gently, and read its free play on a dial gauge or "
                "protractor: half of that.",
            ),
        )
    }
    source = "Nordin and Gutman, Automatica 38, 2002, 1633-1649"
    in_words = "A joint has play: over a small angle it moves without its spring and its friction."
    symptom = "The joint rattles within its play when its load changes sides, and knocks at the ends."
    experiment = "Move the resting joint by hand with a force gauge: within the play it shows no force."
    state_sd = 0.02

    def n_states(self, n_joints: int) -> int:
        """y and dy/dt of each joint [rad, rad/s]."""
        return 2 * n_joints

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        """Return T minus the spring and friction torque of Eq. 12, which it replaces, (n,) [N m]."""
        move, p = now.motion, now.p
        taken = spring_torque(move.theta, p) + joint_friction(move.theta_rate, p, move.slip_rate)
        return _stops(*_play(state, p), params, p) - taken

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        move, p = now.motion, now.p
        (y, moving), (y_rate, speeding) = _play(state, p), _play(state_rate, p)
        held = _spring(move.theta - y, p) + joint_friction(move.theta_rate - moving, p)
        ball = _BALL * (move.theta_acceleration - speeding) + held - _stops(y, moving, params, p)
        return np.concatenate([y_rate - moving, ball])

    def torque_along(self, motion: Array, slip: Array, length: Array, params: EffectParams, p: Parameters) -> Array:
        """Return `torque` for rigid stops and a ball without inertia.

        While a stop moves the ball, T is the torque of spring and friction. Between the stops T is 0: dry friction
        holds the ball, or the spring moves it against viscous friction.
        """
        theta, rate, gap = motion[:, 0], motion[:, 1], params["gap"]
        taken = spring_torque(theta, p) + joint_friction(rate, p, slip)
        friction, held = joint_friction(rate, p, slip), break_away_torque(p)
        yielding = -np.expm1(-np.outer(length, p.stiffness / np.maximum(p.viscous_friction, _LEAST_VISCOUS)))
        ball, T = theta[0] - gap * np.sign(theta[0] - p.rest_angle), np.empty_like(theta)
        for k in range(len(theta)):
            pulled = spring_torque(ball, p)
            beyond = np.maximum(np.abs(pulled) - held, 0.0)
            ball = ball - np.sign(pulled) * beyond * yielding[k] / np.maximum(p.stiffness, _LEAST_VISCOUS)
            passed = theta[k] - ball
            touching = np.abs(passed) > gap
            ball = np.where(touching, theta[k] - gap * np.sign(passed), ball)
            T[k] = np.where(touching, spring_torque(ball, p) + friction[k], 0.0)
        return np.asarray(T - taken)

    def initial_state(self, theta: Array, u: Array, params: EffectParams, p: Parameters) -> Array:
        """Return the states with the ball pulled against a stop by its spring, without friction; by Newton's method."""
        y = theta - p.rest_angle
        for _ in range(_NEWTON_STEPS):
            pushed = (_STOP + p.stiffness) * _passed(y, params) - _spring(theta - y, p)
            y = y - pushed / ((_STOP + p.stiffness) * _touching(y, params) + _ball_stiffness(p))
        return np.concatenate([y, np.zeros(p.n_joints)])


def _play(state: Numbers, p: Parameters) -> tuple[Numbers, Numbers]:
    """Return y and dy/dt, or their rates, (n,) each."""
    return state[: p.n_joints], state[p.n_joints :]


def _spring(ball: Numbers, p: Parameters) -> Numbers:
    """K_b (theta - y - theta_0), (n,) [N m]."""
    return _ball_stiffness(p) * (ball - p.rest_angle)


def _ball_stiffness(p: Parameters) -> Numbers:
    """K_b, (n,) [N m/rad]."""
    return p.stiffness * (1 + p.stiffness / _STOP)


def _stops(y: Numbers, y_rate: Numbers, params: EffectParams, p: Parameters) -> Numbers:
    """T, (n,) [N m]."""
    return (_STOP + p.stiffness) * _passed(y, params) + _STOP_DAMPING * _touching(y, params) * y_rate


def _passed(y: Numbers, params: EffectParams) -> Numbers:
    """z, (n,) [rad]: the part of y beyond the gap."""
    return y - (rounded_size(y + params["gap"], _CORNER) - rounded_size(y - params["gap"], _CORNER)) / 2


def _touching(y: Numbers, params: EffectParams) -> Numbers:
    """z', (n,) [1]: 1 at the stops, 0 within the gap."""
    after, before = y + params["gap"], y - params["gap"]
    return 1 - (after / rounded_size(after, _CORNER) - before / rounded_size(before, _CORNER)) / 2

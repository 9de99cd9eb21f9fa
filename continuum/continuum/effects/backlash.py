"""Play of a joint in series with its spring and friction: the ball that they hold moves the link only by its stops.

The joint's angle is that of the ball, theta - y, and of the link in it, y, which is free within +- gap. The stops are
springs k_s = 3000 N m/rad + K with a damping of d = 10 N m s/rad, their corners rounded within 0.1 mrad; the ball with
its ring has J_b = 1e-6 kg m2 of its own. T takes the place of Eq. 12's spring and friction F (Eq. 13):

  T = k_s z + d z' dy/dt,     z(y) = y - (r(y + gap) - r(y - gap)) / 2,     z' = dz/dy,
  J_b dw/dt = T - K_b (theta - y - theta_0) - F(w),     w = d(theta - y)/dt,     r(y) = sqrt(y^2 + width^2).

K_b = K k_s / (k_s - K), so that without play spring and stops together are the model's K. Stops and ball then change a
release by 0.01 degrees (RMS). A ball without inertia would have to find its speed from F, whose steps no solver likes.

Bolts of 5 mm in holes of 5.2 mm, 10 mm apart, have 0.02 rad each way; within them a link swings free of friction.
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
            "play of a joint to each side",
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
        """T in the place of spring and friction of Eq. 12, (n,) [N m]."""
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
        """With hard stops and a ball without inertia, T is that of spring and friction while a stop moves the ball.

        Between the stops the ball rests by its dry friction, or yields to its spring against the viscous one.
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
        """The ball pulled against its stop by its spring, friction aside; by Newton's method from beyond that stop."""
        y = theta - p.rest_angle
        for _ in range(_NEWTON_STEPS):
            pushed = (_STOP + p.stiffness) * _passed(y, params) - _spring(theta - y, p)
            y = y - pushed / ((_STOP + p.stiffness) * _touching(y, params) + _ball_stiffness(p))
        return np.concatenate([y, np.zeros(p.n_joints)])


def _play(state: Numbers, p: Parameters) -> tuple[Numbers, Numbers]:
    """The two halves of all states, (n,) each."""
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
    """z, (n,) [rad]: what of y is beyond the play."""
    return y - (rounded_size(y + params["gap"], _CORNER) - rounded_size(y - params["gap"], _CORNER)) / 2


def _touching(y: Numbers, params: EffectParams) -> Numbers:
    """z', (n,) [1]: 1 at the stops, 0 within the play."""
    after, before = y + params["gap"], y - params["gap"]
    return 1 - (after / rounded_size(after, _CORNER) - before / rounded_size(before, _CORNER)) / 2

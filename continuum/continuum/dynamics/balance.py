"""The equations of a whole model: Eq. 12 with its effects and their states, and Eq. 18, which solves it for the rates.

The sum of Eq. 12 must be zero. It is linear in the rates v = (theta'', z'), for which Eq. 18 solves it:
r = r(v = 0) + (dr/dv) v. For the thesis's model dr/dv is M. With effects that add states or inertia, its columns are
the balance at unit rates, minus the balance at zero rates.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from continuum.arrays import Array
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.model import ActiveEffect, InputKind, Model
from continuum.dynamics.planar.balance import torque_balance
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.dynamics.planar.instant import Instant, Motion
from continuum.dynamics.planar.rigid_body import inertia_matrix
from continuum.dynamics.tensions import LET_GO

StateSpace = Callable[[Array, Array], Array]
"""Rates of a state (n_x,) under inputs (n_inputs,): (theta', theta'', z'), (n_x,) [rad/s, rad/s2, ...]."""


def balance(model: Model, x: Numbers, v: Numbers, u: Numbers, motion: Motion | None = None) -> Numbers:
    """Return the residual of Eq. 12 and of the effects' equations, (n + n_states,) [N m, and the units of each effect].

    Args:
        model: the model; its values are floats or symbols.
        x: state: joint angles, joint rates, effects' states, (2 n + n_states,) [rad, rad/s, ...].
        v: joint accelerations and rates of the effects' states, (n + n_states,) [rad/s2, ...].
        u: inputs, (n_inputs,): commanded tension of each cable [N], or torque of each joint's drive [N m].
        motion: motion of the joints if it is known already; by default it is computed from ``x`` and ``v``.
    """
    now, commanded = _instant(model, x, v, u, motion or joint_motion(model, x, v))
    parts = list(_parts(model, x, v))
    torque = torque_balance(now)
    for active, state, _ in parts:
        torque = torque + active.effect.torque(now, active.values, state)
    of_states = [
        active.effect.state_balance(replace(now, u=command), active.values, state, rate)
        for (active, state, rate), command in zip(parts, commanded, strict=True)
    ]
    return np.concatenate([torque, *of_states])


def joint_motion(model: Model, x: Numbers, v: Numbers) -> Motion:
    """Return the motion of the joints in a state, with the base at rest."""
    n, still = model.n_joints, np.zeros(1)
    return Motion(x[:n], x[n : 2 * n], v[:n], still, still, still)


def _instant(model: Model, x: Numbers, v: Numbers, u: Numbers, motion: Motion) -> tuple[Instant, list[Numbers]]:
    """Return the instant that the torques depend on, and the tensions before each effect changes them."""
    drive, commanded = np.zeros(1), []
    if model.inputs is InputKind.JOINT_TORQUES:
        drive, u = u, np.full(len(SIDES), LET_GO)
    for active, state, rate in _parts(model, x, v):
        commanded.append(u)
        motion = active.effect.move_base(motion, active.values, state, rate)
        u = active.effect.pull(u, active.values, state)
    return Instant(motion, u, model.changed_parameters, drive), commanded


def _parts(model: Model, x: Numbers, v: Numbers) -> Iterator[tuple[ActiveEffect, Numbers, Numbers]]:
    """Yield each effect with its states and their rates."""
    at = model.n_joints
    for active in model.effects:
        end = at + active.effect.n_states(model.n_joints)
        yield active, x[model.n_joints + at : model.n_joints + end], v[at:end]
        at = end


def numpy_state_space(model: Model) -> StateSpace:
    """Return Eq. 18 of a model, evaluated term by term in NumPy."""
    n, size = model.n_joints, model.n_joints + model.n_states
    unit = np.eye(size)

    def rates(x: Array, u: Array) -> Array:
        rest = balance(model, x, np.zeros(size), u)
        if model.effects:
            matrix = np.stack([balance(model, x, column, u) - rest for column in unit], axis=1)
        else:
            matrix = inertia_matrix(np.cumsum(x[:n]), model.parameters)
        return np.concatenate([x[n : 2 * n], -lu_solve(lu_factor(matrix), rest)])

    return rates

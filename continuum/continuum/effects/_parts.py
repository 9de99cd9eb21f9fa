"""Equations shared by several effects: vectors along links, rounded corners, cable lengths, forces in the joints.

Corners are rounded within a stated width, so that fits can differentiate a motion with respect to the parameters of an
effect. Vectors in the plane that rotates with the links are (n, 2) in (x, z).
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers, positive_part, suffix_sum, where_positive
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.cable_lengths import SIDES, chord_jacobian, chord_lengths
from continuum.dynamics.planar.capstan_law import tension_propagation
from continuum.dynamics.planar.instant import Instant, Motion

LEAST_LAG = 1e-5
"""Shortest time constant [s], too small to be observed; at zero the states would have no rates."""

_HALF_DRIVEN = 0.1
"""Command [N] at which `driven` is one half; well below it, the motor does not act on the cable."""


def along(angle: Numbers) -> Numbers:
    """Unit vector at each angle (n,) [rad] from the axis of the straight arm, (n, 2)."""
    return np.stack([np.sin(angle), np.cos(angle)], axis=1)


def across(angle: Numbers) -> Numbers:
    """Unit vector perpendicular to `along`, towards increasing angles, (n, 2): the derivative of `along`."""
    return np.stack([np.cos(angle), -np.sin(angle)], axis=1)


def sum_before(vectors: Numbers) -> Numbers:
    """Sum of the vectors of all links before each link, (n, 2)."""
    return np.cumsum(vectors, axis=0) - vectors


def rounded_size(x: Numbers, width: float) -> Numbers:
    """Smooth |x|, at least ``width``: sqrt(x^2 + width^2), in the unit of both."""
    return np.sqrt(x * x + width * width)


def rounded_part(x: Numbers, width: float) -> Numbers:
    """Smooth positive part of x, half of ``width`` at 0: (x + sqrt(x^2 + width^2)) / 2."""
    return (x + rounded_size(x, width)) / 2


def lengthening(move: Motion, p: Parameters) -> Numbers:
    """Excess length of each cable's path through the arm over that through the straight arm, (n_cables,) [m]."""
    return chord_lengths(move.theta, p).sum(axis=0) - 2 * p.half_spacing.sum(keepdims=True)


def lengthening_rate(move: Motion, p: Parameters) -> Numbers:
    """Rate of `lengthening`, (n_cables,) [m/s]."""
    return (chord_jacobian(move.theta, p) * move.theta_rate[:, None]).sum(axis=0)


def controlled(u: Numbers) -> Numbers:
    """1 if a motor controls the cable, even at zero tension; 0 if the cable was released, (n_cables,)."""
    return where_positive(-u, 0.0, 1.0)


def driven(u: Numbers) -> Numbers:
    """Near 1 if the command is a tension, 0 at zero command, (n_cables,): u^2 / (u^2 + (0.1 N)^2)."""
    return u * u / (u * u + _HALF_DRIVEN**2)


class CableStates(Effect):
    """Base of effects whose states are the acting tensions: T of each cable [N], initially the commanded tension."""

    def n_states(self, n_joints: int) -> int:
        return len(SIDES)

    def pull(self, u: Numbers, params: EffectParams, state: Numbers) -> Numbers:
        return state

    def initial_state(self, theta: Array, u: Array, params: EffectParams, p: Parameters) -> Array:
        return u.copy()


def joint_force(now: Instant) -> Numbers:
    """Force that each joint transmits to the links beyond it, (n, 2) in (x, z) [N].

    It carries the weight, provides the centripetal force, and balances the cable tensions, which compress the joint;
    joint accelerations are neglected.
    """
    move, p = now.motion, now.p
    phi, turning = move.link_angle, (move.link_rate**2)[:, None] * along(move.link_angle)
    inwards = sum_before(p.joint_spacing[:, None] * turning) + p.center_of_mass[:, None] * turning
    down = p.gravity * np.concatenate([-np.sin(p.hang_angle), np.cos(p.hang_angle)])
    of_mass = -suffix_sum(p.mass[:, None] * (inwards + down))
    if not p.has_cables:
        return of_mass
    pull = (tension_propagation(move.theta, move.slip_rate, p) * positive_part(now.u)).sum(axis=1)
    return pull[:, None] * along(phi - move.theta / 2) + of_mass

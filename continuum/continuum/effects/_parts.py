"""Equations that several effects need: vectors along the links, rounded corners, cables, forces in the joints.

Corners are rounded within a stated width, for fits that differentiate the motion by an effect's parameters. Vectors in
the plane that links carry are (n, 2) in (x, z).
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
"""Shortest time constant [s], of which nothing is seen: without any, the states would have no rates."""

_LET_GO = 0.1
"""A motor that is told half of its work at this tension [N]: below, it lets the cable be."""


def along(angle: Numbers) -> Numbers:
    """Unit vector along each angle from the straight arm, (n, 2) of (n,) [rad]."""
    return np.stack([np.sin(angle), np.cos(angle)], axis=1)


def across(angle: Numbers) -> Numbers:
    """Unit vector across it, towards growing angles: the slope of `along`, (n, 2)."""
    return np.stack([np.cos(angle), -np.sin(angle)], axis=1)


def sum_before(vectors: Numbers) -> Numbers:
    """Of every link, the sum of the vectors of those before it, (n, 2)."""
    return np.cumsum(vectors, axis=0) - vectors


def rounded_size(x: Numbers, width: float) -> Numbers:
    """|x|, never below ``width``: sqrt(x^2 + width^2), in the unit of both."""
    return np.sqrt(x * x + width * width)


def rounded_part(x: Numbers, width: float) -> Numbers:
    """The positive part of x, half of ``width`` at 0: (x + sqrt(x^2 + width^2)) / 2."""
    return (x + rounded_size(x, width)) / 2


def lengthening(move: Motion, p: Parameters) -> Numbers:
    """By how much each cable's way through the arm is longer than in the straight one, (n_cables,) [m]."""
    return chord_lengths(move.theta, p).sum(axis=0) - 2 * p.half_spacing.sum(keepdims=True)


def lengthening_rate(move: Motion, p: Parameters) -> Numbers:
    """Rate of the same, (n_cables,) [m/s]."""
    return (chord_jacobian(move.theta, p) * move.theta_rate[:, None]).sum(axis=0)


def led(u: Numbers) -> Numbers:
    """1 where a motor leads the cable, be it to no tension, 0 where it was let go, (n_cables,)."""
    return where_positive(-u, 0.0, 1.0)


def driven(u: Numbers) -> Numbers:
    """1 where a motor is told to pull, 0 where it is told nothing, (n_cables,): u^2 / (u^2 + (0.1 N)^2)."""
    return u * u / (u * u + _LET_GO**2)


class CableStates(Effect):
    """Base of effects whose states are the tensions that pull: T of each cable [N], at first what is commanded."""

    def n_states(self, n_joints: int) -> int:
        return len(SIDES)

    def pull(self, u: Numbers, params: EffectParams, state: Numbers) -> Numbers:
        return state

    def initial_state(self, theta: Array, u: Array, params: EffectParams, p: Parameters) -> Array:
        return u.copy()


def joint_force(now: Instant) -> Numbers:
    """Force of what lies before each joint on what lies beyond it, (n, 2) in (x, z) [N]; accelerations as 0.

    Weight, what keeps the load on a curved way, and the pull of cables that press the joint together.
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

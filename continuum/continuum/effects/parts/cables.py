"""Cables of the whole section: their speed at the base, and whether a motor pulls them."""

from __future__ import annotations

from continuum.dynamics.expressions import Numbers, where_positive
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.cables import chord_jacobian, chord_lengths
from continuum.dynamics.planar.motion import Motion

_LET_GO = 0.1
"""A motor that is told half of its work at this tension [N]: below, it lets the cable be."""


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

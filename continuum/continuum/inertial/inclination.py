"""Angle of a link about its axis from the direction of gravity, for use at rest, and joints from links.

A joint's angle is the difference of neighbouring links; the first link's neighbour is the base, which does not move.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array


def inclination(forces: Array, axis: Array, zero: Array) -> Array:
    """Return link angles in (-pi, pi], (..., n) [rad].

    If a link turns by alpha about a fixed axis n, gravity turns back by alpha in its sensor's axes:
    f(alpha) = R(n, -alpha) f_0, whatever the part of f along n. So without the parts of all vectors along n,

        alpha = atan2(n . (f x f_0), f . f_0).

    Args:
        forces: specific forces f, (..., n, 3) [m/s2]; only the direction counts.
        axis: n of each sensor in the sensor's axes, unit vectors, (n, 3).
        zero: specific forces f_0 at the angle zero, (n, 3) [m/s2].
    """
    across, across_zero = across_axis(forces, axis), across_axis(zero, axis)
    sine = np.sum(axis * np.cross(across, across_zero), axis=-1)
    return np.asarray(np.arctan2(sine, np.sum(across * across_zero, axis=-1)))


def across_axis(vectors: Array, axis: Array) -> Array:
    """Return vectors without their part along the unit vectors ``axis``, (..., 3)."""
    return np.asarray(vectors - axis * np.sum(axis * vectors, axis=-1, keepdims=True))


def turned(vectors: Array, axis: Array, angles: Array) -> Array:
    """Return R(n, angle) v by Rodrigues' formula, (n, 3): vectors turned about unit vectors ``axis`` by ``angles``."""
    cosine, sine = np.cos(angles)[:, None], np.sin(angles)[:, None]
    along = axis * np.sum(axis * vectors, axis=1, keepdims=True)
    return np.asarray(cosine * vectors + sine * np.cross(axis, vectors) + (1 - cosine) * along)


def of_neighbours(links: Array) -> Array:
    """Return angles or rates of the joints from those of the links, (..., n): theta_i = alpha_i - alpha_(i-1)."""
    return np.asarray(np.diff(links, axis=-1, prepend=0.0))


def within_half_a_turn(angles: Array) -> Array:
    """Return the same angles in [-pi, pi) [rad]."""
    return np.asarray((angles + np.pi) % (2 * np.pi) - np.pi)


def with_neighbour(errors: Array) -> Array:
    """Return errors of the joints' angles from independent errors of the links' angles, (n,) [rad]."""
    before = np.concatenate([[0.0], errors[:-1]])
    return np.asarray(np.hypot(errors, before))

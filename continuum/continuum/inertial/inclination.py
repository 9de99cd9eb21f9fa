"""Angle of a link about its axis by the direction of gravity, for use at rest."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array


def inclination(forces: Array, axis: Array, zero: Array) -> Array:
    """Link angles in (-pi, pi], (..., n) [rad].

    A link that turns by alpha about an axis n that stands still turns what its sensor sees of gravity back by alpha:
    f(alpha) = R(n, -alpha) f_0, whatever part of f lies along n. So with all vectors' parts along n left out

        alpha = atan2(n . (f x f_0), f . f_0).

    Args:
        forces: specific forces f, (..., n, 3) [m/s2]; only the direction counts.
        axis: n of each sensor in its own axes, unit vectors, (n, 3).
        zero: specific forces f_0 at the angle zero, (n, 3) [m/s2].
    """
    across, across_zero = across_axis(forces, axis), across_axis(zero, axis)
    sine = np.sum(axis * np.cross(across, across_zero), axis=-1)
    return np.asarray(np.arctan2(sine, np.sum(across * across_zero, axis=-1)))


def across_axis(vectors: Array, axis: Array) -> Array:
    """The vectors without their part along the unit vectors ``axis``, (..., 3)."""
    return np.asarray(vectors - axis * np.sum(axis * vectors, axis=-1, keepdims=True))


def turned(vectors: Array, axis: Array, angles: Array) -> Array:
    """R(n, angle) v by Rodrigues' formula, (n, 3): vectors turned about their unit vectors ``axis`` by ``angles``."""
    cosine, sine = np.cos(angles)[:, None], np.sin(angles)[:, None]
    along = axis * np.sum(axis * vectors, axis=1, keepdims=True)
    return np.asarray(cosine * vectors + sine * np.cross(axis, vectors) + (1 - cosine) * along)

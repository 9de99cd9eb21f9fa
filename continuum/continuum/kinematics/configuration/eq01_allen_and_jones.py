"""Thesis Eqs. 1 to 3: Allen's (u, v) and Jones's (phi, theta) (Allen et al. 2020; Jones and Walker 2006)."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array


def bend(w: Array) -> Array:
    """Total bend theta [rad] (...) of configurations ``w`` (..., 2) [rad]: Eq. 1, theta = hypot(u, v)."""
    return np.hypot(w[..., 0], w[..., 1])


def jones_from_allen(w: Array) -> tuple[Array, Array]:
    """Azimuth phi in (-pi, pi] and bend theta >= 0 [rad] of ``w`` (..., 2) [rad]: Eqs. 1 and 2.

    phi = atan2(-u, v); it is 0 in the straight posture, where every azimuth would do.
    """
    u, v = w[..., 0], w[..., 1]
    return np.arctan2(0.0 - u, 0.0 + v), bend(w)


def allen_from_jones(phi: Array | float, theta: Array | float) -> Array:
    """Allen's ``w`` (..., 2) [rad] of azimuth and bend [rad]: Eq. 3, (u, v) = theta (-sin phi, cos phi)."""
    return np.stack([-theta * np.sin(phi), theta * np.cos(phi)], axis=-1)

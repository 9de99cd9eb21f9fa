"""Thesis Eq. 22: rates of a section's configuration from the velocity of the point that Eq. 5 reads."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import polynomial

from continuum.arrays import Array

_SMALL = 0.05
_SERIES = (-4 / 3, 8 / 5, -12 / 7, 16 / 9, -20 / 11, 24 / 13)


def jones_from_point_jacobian(point: Array) -> Array:
    """d(phi, theta) / d(x, y, z), (..., 2, 3) [rad/m], at ``point`` (..., 3) [m]: Eq. 22 as printed.

    Not finite on the z axis, where phi is not defined; :func:`configuration_from_point_jacobian` is.
    """
    x, y, z = point[..., 0], point[..., 1], point[..., 2]
    radius, distance_squared = np.hypot(x, y), np.sum(point * point, axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        phi_row = [-y / radius**2, x / radius**2, np.zeros_like(x)]
        theta_row = [2 * x * z / radius, 2 * y * z / radius, -2 * radius]
    theta_row = [entry / distance_squared for entry in theta_row]
    return np.stack([np.stack(phi_row, axis=-1), np.stack(theta_row, axis=-1)], axis=-2)


def configuration_from_point_jacobian(point: Array) -> Array:
    """d(u, v) / d(x, y, z), (..., 2, 3) [rad/m], at ``point`` (..., 3) [m], regular in the straight posture.

    With r = hypot(x, y) and f = theta / r: (u, v) = f (-y, x), so the slope of f over r is all that needs care.
    Not finite straight down (x = y = 0, z <= 0), where the configuration itself jumps.
    """
    x, y, z = point[..., 0], point[..., 1], point[..., 2]
    radius, distance_squared = np.hypot(x, y), np.sum(point * point, axis=-1)
    near_axis = (radius < _SMALL * np.abs(z)) & (z > 0.0)
    safe_z, safe_radius = np.where(near_axis, z, 1.0), np.where(near_axis, 1.0, radius)
    theta = 2.0 * np.arctan2(radius, z)
    with np.errstate(divide="ignore", invalid="ignore"):
        per_radius = np.where(near_axis, 2.0 * _atan_ratio(radius / safe_z) / safe_z, theta / safe_radius)
        derivative = np.where(
            near_axis,
            polynomial.polyval((radius / safe_z) ** 2, _SERIES) / safe_z**3,
            (2.0 * z * radius / distance_squared - theta) / safe_radius**3,
        )
        along_z = -2.0 / distance_squared
    rows = [
        [-derivative * x * y, -derivative * y * y - per_radius, -along_z * y],
        [derivative * x * x + per_radius, derivative * x * y, along_z * x],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _atan_ratio(t: Array) -> Array:
    """atan(t) / t."""
    zero = t == 0.0
    return np.where(zero, 1.0, np.arctan(t) / np.where(zero, 1.0, t))

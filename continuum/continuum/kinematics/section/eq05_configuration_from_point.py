"""Thesis Eq. 5, IK_gen: configuration of a section whose tip is seen at a point, without the case split.

For an inextensible section this is a projection: only the direction of the point is used.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.smooth_functions import Real


def configuration_entries(x: Real, y: Real, z: Real) -> tuple[Real, Real]:
    """(u, v) [rad] of a section whose tip lies in the direction (x, y, z) of any length."""
    radius = np.hypot(x, y)
    theta = 2.0 * np.arctan2(radius, z)
    safe_radius = radius + (radius == 0.0)
    return -theta * (y / safe_radius), theta * (x / safe_radius)


def configuration_from_point(point: Array) -> Array:
    """Configuration ``w`` (..., 2) [rad] of a section whose tip lies in the direction of ``point`` (..., 3) [m].

    theta = 2 atan2(hypot(x, y), z), phi = atan2(y, x). Below the base plane theta goes beyond 180 degrees. Straight
    down (x = y = 0, z < 0) every azimuth is right; w is (0, 0) there, and for the zero point,
    which has no direction.
    """
    return np.stack(configuration_entries(point[..., 0], point[..., 1], point[..., 2]), axis=-1)

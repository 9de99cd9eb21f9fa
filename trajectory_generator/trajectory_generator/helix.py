"""Via points on a helix about the z axis (thesis 4.1)."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from trajectory_generator.checked_arrays import finite_array, positive

MOST_POINTS = 100_000
"""Largest accepted number of via points."""


def helix_points(radius: float, pitch: float, z_start: float, z_end: float, n_points: int) -> Array:
    """Return points (n_points, 3) [m] at equal steps on a right-handed helix that starts above the x axis.

    azimuth(z) = 2 pi (z - z_start) / pitch; the helix may rise or fall.

    Args:
        radius: distance from the z axis [m].
        pitch: rise per revolution [m].
        z_start, z_end: heights of the first and the last point [m].
        n_points: number of points, both ends included; 2 to ``MOST_POINTS``.

    Raises:
        InvalidValueError: a value is out of its range.
    """
    positive("radius", radius, "m")
    positive("pitch", pitch, "m")
    finite_array("z_start", z_start, ())
    finite_array("z_end", z_end, ())
    if not 2 <= n_points <= MOST_POINTS:
        raise InvalidValueError("n_points", n_points, f"a whole number from 2 to {MOST_POINTS}")
    if z_end == z_start:
        raise InvalidValueError("z_end", z_end, "a height other than z_start")
    z = np.linspace(z_start, z_end, n_points)
    azimuth = 2 * np.pi * (z - z_start) / pitch
    return np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), z], axis=-1)

"""The straight line from a section's base disc to its tip disc, and how it shortens as the section bends.

The section is a polygon of n_j + 1 links: b, 2b, ..., 2b, b. Bent evenly, its links make the angles
n_j x, (n_j - 2) x, ..., -n_j x with the chord, where x = theta / (2 n_j); the chord itself leaves the base at
theta / 2. So the chord is the sum of the links' projections, for any bend, and no quotient needs a limit.
"""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.smooth_functions import sinc


def _links(section: Section) -> tuple[Array, Array]:
    """Lengths of the links [m] and their angles to the chord as multiples of theta, each (n_joints + 1,)."""
    n = section.n_joints
    lengths = np.full(n + 1, 2 * section.b)
    lengths[[0, -1]] = section.b
    return lengths, (n - 2 * np.arange(n + 1)) / (2 * n)


def chord_length(theta: Array, section: Section) -> Array:
    """Distance [m] (...) from base disc to tip disc, signed along theta / 2, at bend ``theta`` (...) [rad]."""
    lengths, multiples = _links(section)
    return np.cos(np.asarray(theta)[..., None] * multiples) @ lengths


def chord_slope(theta: Array, section: Section) -> Array:
    """(d chord / d theta) / theta [m/rad^2] (...), finite in the straight posture."""
    lengths, multiples = _links(section)
    return -sinc(np.asarray(theta)[..., None] * multiples) @ (lengths * multiples**2)

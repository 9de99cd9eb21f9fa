"""The straight line from a section's base disc to its tip disc, and how it shortens as the section bends.

The section is a polygon of n_j + 1 links: b, 2b, ..., 2b, b. Bent evenly, its links make the angles
n_j x, (n_j - 2) x, ..., -n_j x with the chord, where x = theta / (2 n_j); the chord itself leaves the base at
theta / 2. So the chord is the sum of the links' projections, for any bend, and no quotient needs a limit.
"""

from __future__ import annotations

import numpy as np

from continuum.kinematics.smooth_functions import Real, sinc


def chord_length(theta: Real, b: float, n_joints: int) -> Real:
    """Distance [m] from base disc to tip disc, signed along theta / 2, at bend ``theta`` [rad]; ``b`` [m]."""
    total: Real = 2 * b * np.cos(0.5 * theta)  # the two half links at the ends
    for k in range(1, (n_joints + 1) // 2):  # pairs of links, as far to one side of the chord as to the other
        total = total + 4 * b * np.cos((0.5 - k / n_joints) * theta)
    if n_joints % 2 == 0:
        total = total + 2 * b  # the link in the middle, along the chord
    return total


def chord_derivative(theta: Real, b: float, n_joints: int) -> Real:
    """(d chord / d theta) / theta [m/rad^2], finite in the straight posture."""
    total = -0.5 * b * sinc(0.5 * theta)
    for k in range(1, (n_joints + 1) // 2):
        multiple = 0.5 - k / n_joints
        total = total - 4 * b * multiple * multiple * sinc(multiple * theta)
    return total

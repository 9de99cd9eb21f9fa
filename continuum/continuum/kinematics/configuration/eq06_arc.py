"""Thesis Eqs. 6 and 7: arc length and curvature of the arc through the discs of an inextensible section."""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array


def curvature(theta: Array, section: Section) -> Array:
    """Curvature kappa [1/m] (...) at bend ``theta`` (...) [rad]: Eq. 7, kappa = tan(theta / (2 n_j)) / b."""
    return np.tan(theta / (2 * section.n_joints)) / section.b


def arc_length(theta: Array, section: Section) -> Array:
    """Arc length s [m] (...) at bend ``theta`` (...) [rad]: Eq. 6, s = b theta / tan(theta / (2 n_j)).

    The arc touches every disc; it is the backbone's length 2 n_j b when straight and shortens as the section bends.
    """
    x = np.asarray(theta, dtype=float) / (2 * section.n_joints)
    straight = x == 0.0
    return section.length * np.where(straight, 1.0, x / np.tan(np.where(straight, 1.0, x)))

"""Thesis Eq. 8, IK_spe: lengths of the cables through a section, for any number of cables at any azimuth.

The chord of cable j in one module is l_j = 2 (b cos x - a cos(phi - alpha_j) sin x) with x = theta / (2 n_j); a section
has n_j modules. The printed norm is this chord's absolute value; it changes sign at `Section.contact_bend`.
"""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.configuration import bend
from continuum.kinematics.smooth_functions import sinc


def cable_lengths(w: Array, section: Section, a: Array | None = None, azimuths: Array | None = None) -> Array:
    """Lengths (..., n_cables) [m] within the section at ``w`` (..., 2) [rad].

    Args:
        w: configurations of the section.
        section: the section that the cables run through.
        a: radius of each cable's holes, (n_cables,) [m]; the section's own without it.
        azimuths: azimuth of each cable in the section's frame, (n_cables,) [rad]; the section's own without it.
    """
    return chords(w, section.b, section.n_joints, *cable_holes(section, a, azimuths))


def chords(w: Array, b: Array | float, n_joints: Array | float, a: Array, azimuths: Array) -> Array:
    """Sums (..., n_cables) [m] of a section's ``n_joints`` chords at ``w`` (..., 2) [rad].

    ``b``, ``a`` [m] and ``azimuths`` [rad] are (..., n_cables) and ``n_joints`` (..., 1), or one number for all.
    """
    x = bend(w)[..., None] / (2 * n_joints)
    return 2 * n_joints * b * np.cos(x) - a * sinc(x) * bend_towards(w, azimuths)


def bend_towards(w: Array, azimuths: Array) -> Array:
    """Bend seen from each azimuth, theta cos(phi - alpha_j) (..., n_cables) [rad]."""
    return w[..., 1, None] * np.cos(azimuths) - w[..., 0, None] * np.sin(azimuths)


def cable_holes(section: Section, a: Array | None, azimuths: Array | None) -> tuple[Array, Array]:
    """Radii [m] and azimuths [rad] of the cables' holes, (n_cables,): those given, or the section's own."""
    azimuths = np.asarray(section.cable_azimuths if azimuths is None else azimuths, dtype=float)
    return np.broadcast_to(section.a if a is None else np.asarray(a, dtype=float), azimuths.shape), azimuths

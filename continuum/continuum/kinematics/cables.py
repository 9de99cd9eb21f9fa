"""Cables through a section: lengths from the configuration and back, the rates between them, and their holes.

A section may have any number of cables at any azimuths. The chord of cable j in one module is
l_j = 2 (b cos x - a cos(phi - alpha_j) sin x) with x = theta / (2 n_j); a section has n_j modules. The printed norm of
Eq. 8 is this chord's absolute value; it changes sign at `Section.contact_bend`.

With (X, Y) = 2 n_j sin x (cos phi, sin phi) and C = 2 n_j b cos x, cable j of a section measures
l_j = C - a (X cos alpha_j + Y sin alpha_j). Three cables or more give (X, Y, C) by linear least squares, and the
module's chord points along (X, Y, C / b): Eq. 5 applied to it gives one module's bend. Four cables a quarter turn apart
give the thesis's Eq. 9.

============================  =======================================================
cable_lengths, chords         Eq. 8, IK_spe
configuration_from_cables     Eq. 9, FK_spe; as printed: docs/errata.md
configuration_cable_jacobian  slope of Eq. 9, J_zeta,q of Eq. 11
cable_jacobian                Eqs. 25, 26; the printed phi entry lost a square: docs/errata.md
chord_jacobian                Eqs. 25, 26
hole_points, holes_of_discs   the holes whose distances Eq. 8 adds up
============================  =======================================================
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.configuration import bend
from continuum.kinematics.discs import disc_poses, even_bends
from continuum.kinematics.section import configuration_from_point, configuration_from_point_jacobian
from continuum.kinematics.smooth_functions import sinc, sinc_derivative


def cable_lengths(w: Array, section: Section, a: Array | None = None, azimuths: Array | None = None) -> Array:
    """Return the lengths (..., n_cables) [m] within the section at ``w`` (..., 2) [rad]: Eq. 8, IK_spe.

    Args:
        w: configurations of the section.
        section: the section that the cables run through.
        a: radius of each cable's holes, (n_cables,) [m]; by default that of the section's actuating cables.
        azimuths: azimuth of each cable in the section's frame, (n_cables,) [rad]; by default those of the section's
            actuating cables.
    """
    return chords(w, section.b, section.n_joints, *cable_holes(section, a, azimuths))


def chords(w: Array, b: Array | float, n_joints: Array | float, a: Array, azimuths: Array) -> Array:
    """Sums (..., n_cables) [m] of a section's ``n_joints`` chords at ``w`` (..., 2) [rad]: Eq. 8.

    ``b``, ``a`` [m] and ``azimuths`` [rad] are (..., n_cables) and ``n_joints`` (..., 1), or one number for all.
    """
    x = bend(w)[..., None] / (2 * n_joints)
    return 2 * n_joints * b * np.cos(x) - a * sinc(x) * bend_towards(w, azimuths)


def bend_towards(w: Array, azimuths: Array) -> Array:
    """Bend seen from each azimuth, theta cos(phi - alpha_j) (..., n_cables) [rad]."""
    return w[..., 1, None] * np.cos(azimuths) - w[..., 0, None] * np.sin(azimuths)


def cable_holes(section: Section, a: Array | None, azimuths: Array | None) -> tuple[Array, Array]:
    """Radii [m] and azimuths [rad] of the cables' holes, (n_cables,): the given ones, or by default the section's."""
    azimuths = np.asarray(section.cable_azimuths if azimuths is None else azimuths, dtype=float)
    return np.broadcast_to(section.a if a is None else np.asarray(a, dtype=float), azimuths.shape), azimuths


def configuration_from_cables(lengths: Array, section: Section) -> Array:
    """Configuration ``w`` (..., 2) [rad] from the lengths (..., n_cables) [m] of the section's actuating cables: Eq. 9.

    A linear least-squares fit over all cables gives one module's chord (X, Y, C / b); only its direction counts.
    Exact for consistent lengths, near the nearest consistent ones otherwise.
    """
    return section.n_joints * configuration_from_point(lengths @ _point_of_lengths(section).T)


def configuration_cable_jacobian(lengths: Array, section: Section) -> Array:
    """Slope of Eq. 9, d(u, v) / d length, (..., 2, n_cables) [rad/m], at ``lengths`` (..., n_cables) [m]."""
    matrix = _point_of_lengths(section)
    return section.n_joints * configuration_from_point_jacobian(lengths @ matrix.T) @ matrix


@lru_cache
def _point_of_lengths(section: Section) -> Array:
    """Matrix (3, n_cables) that gives (X, Y, C / b), the direction of one module's chord, from the cables' lengths.

    The result is cached, because streams of messages need it repeatedly.
    """
    azimuths = np.asarray(section.cable_azimuths)
    measured = np.stack(
        [-section.a * np.cos(azimuths), -section.a * np.sin(azimuths), np.full_like(azimuths, section.b)], axis=-1
    )
    return np.linalg.pinv(measured)


def cable_jacobian(w: Array, section: Section, a: Array | None = None, azimuths: Array | None = None) -> Array:
    """Eq. 26: d length / d(u, v), (..., n_cables, 2) [m/rad], at ``w`` (..., 2) [rad]; arguments as for Eq. 8."""
    return chord_jacobian(w, section.b, section.n_joints, *cable_holes(section, a, azimuths))


def chord_jacobian(w: Array, b: Array | float, n_joints: Array | float, a: Array, azimuths: Array) -> Array:
    """Eqs. 25 and 26: derivatives (..., n_cables, 2) [m/rad] of :func:`chords`, with its arguments."""
    n = n_joints
    x = bend(w)[..., None] / (2 * n)
    towards = np.stack([-np.sin(azimuths), np.cos(azimuths)], axis=-1)
    along_bend = -b * sinc(x) / (2 * n) - a * sinc_derivative(x) / (4 * n * n) * bend_towards(w, azimuths)
    jacobian: Array = along_bend[..., None] * w[..., None, :] - (a * sinc(x))[..., None] * towards
    return jacobian


def hole_points(w: Array, section: Section, a: Array | None = None, azimuths: Array | None = None) -> Array:
    """Holes (..., n_cables, n_joints + 1, 3) [m] in the section's base frame at ``w`` (..., 2) [rad].

    Between two discs a cable is straight, so the segments between its holes add up to its length of Eq. 8.

    Arguments are those of :func:`cable_lengths`.
    """
    return holes_of_discs(disc_poses(even_bends(w, section), section), *cable_holes(section, a, azimuths))


def holes_of_discs(discs: Array, a: Array, azimuths: Array) -> Array:
    """Holes (..., n_cables, n_discs, 3) [m] in discs at the poses (..., n_discs, 4, 4) [m].

    Args:
        discs: poses of the discs.
        a: radius of each cable's holes, (n_cables,) [m].
        azimuths: azimuth of each cable in the section's frame, (n_cables,) [rad].
    """
    in_disc = np.stack([a * np.cos(azimuths), a * np.sin(azimuths), np.zeros_like(azimuths)], axis=-1)
    points: Array = in_disc @ np.swapaxes(discs[..., :3, :3], -1, -2) + discs[..., None, :3, 3]
    return np.swapaxes(points, -2, -3)

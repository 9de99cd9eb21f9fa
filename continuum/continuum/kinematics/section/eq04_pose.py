"""Thesis Eq. 4, FK_gen: pose of a section's tip in its base frame. Entry (1,1) as printed is wrong: docs/errata.md."""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.rigid import Entries3, Entries9, matrix, transform, vector
from continuum.kinematics.section.chord import chord_length
from continuum.kinematics.smooth_functions import Real, sinc, versine


def rotation_entries(u: Real, v: Real) -> Entries9:
    """The rotation of Eq. 4, row by row, at (u, v) [rad]: exp([u, v, 0])."""
    theta = np.hypot(u, v)
    gamma, xi = -versine(theta), sinc(theta)
    return (
        gamma * v * v + 1.0, -gamma * u * v, xi * v,
        -gamma * u * v, gamma * u * u + 1.0, -xi * u,
        -xi * v, xi * u, np.cos(theta),
    )  # fmt: skip


def position_entries(u: Real, v: Real, b: float, n_joints: int) -> Entries3:
    """The position of Eq. 4 [m] at (u, v) [rad]; ``b`` [m].

    The chord leaves the base at half the bend: p = c (sin(theta/2) cos phi, sin(theta/2) sin phi, cos(theta/2)).
    """
    theta = np.hypot(u, v)
    chord = chord_length(theta, b, n_joints)
    lateral = 0.5 * chord * sinc(0.5 * theta)
    return (lateral * v, -lateral * u, chord * np.cos(0.5 * theta))


def section_rotation(w: Array) -> Array:
    """Rotation (..., 3, 3) of the tip frame in the base frame at ``w`` (..., 2) [rad]."""
    return matrix(rotation_entries(w[..., 0], w[..., 1]))


def section_position(w: Array, section: Section) -> Array:
    """Position (..., 3) [m] of the tip disc in the base frame at ``w`` (..., 2) [rad]."""
    return vector(position_entries(w[..., 0], w[..., 1], section.b, section.n_joints))


def section_pose(w: Array, section: Section) -> Array:
    """Homogeneous transform (..., 4, 4) [m] from the tip frame D to the base frame P at ``w`` (..., 2) [rad]."""
    return transform(section_rotation(w), section_position(w, section))

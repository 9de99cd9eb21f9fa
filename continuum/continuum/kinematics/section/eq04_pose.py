"""Thesis Eq. 4, FK_gen: pose of a section's tip in its base frame. Entry (1,1) as printed is wrong: docs/errata.md."""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.configuration import bend
from continuum.kinematics.rigid import transform
from continuum.kinematics.section.chord import chord_length
from continuum.kinematics.smooth_functions import sinc, versine


def section_rotation(w: Array) -> Array:
    """Rotation (..., 3, 3) of the tip frame in the base frame at ``w`` (..., 2) [rad]: exp([u, v, 0])."""
    u, v = w[..., 0], w[..., 1]
    theta = bend(w)
    gamma, xi = -versine(theta), sinc(theta)
    rows = [
        [gamma * v * v + 1.0, -gamma * u * v, xi * v],
        [-gamma * u * v, gamma * u * u + 1.0, -xi * u],
        [-xi * v, xi * u, np.cos(theta)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def section_position(w: Array, section: Section) -> Array:
    """Position (..., 3) [m] of the tip disc in the base frame at ``w`` (..., 2) [rad].

    The chord leaves the base at half the bend: p = c (sin(theta/2) cos phi, sin(theta/2) sin phi, cos(theta/2)).
    """
    u, v = w[..., 0], w[..., 1]
    theta = bend(w)
    chord = chord_length(theta, section)
    lateral = 0.5 * chord * sinc(0.5 * theta)
    return np.stack([lateral * v, -lateral * u, chord * np.cos(0.5 * theta)], axis=-1)


def section_pose(w: Array, section: Section) -> Array:
    """Homogeneous transform (..., 4, 4) [m] from the tip frame D to the base frame P at ``w`` (..., 2) [rad]."""
    return transform(section_rotation(w), section_position(w, section))

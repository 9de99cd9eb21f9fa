"""Thesis Eqs. 20 and 21: velocity of a section's tip from the rates of its configuration. Printed: docs/errata.md."""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.configuration import allen_from_jones, allen_rate_jacobian, bend
from continuum.kinematics.section.chord import chord_length, chord_slope
from continuum.kinematics.section.eq04_pose import section_position
from continuum.kinematics.smooth_functions import one_minus_sinc, sinc, sinc_slope, versine


def section_jacobian(w: Array, section: Section) -> Array:
    """Geometric Jacobian (..., 6, 2) of the tip at ``w`` (..., 2) [rad], in the section's base frame.

    Rows: linear velocity of the tip point [m/rad], then angular velocity [rad/rad]; columns: u, v.
    """
    return np.concatenate([_position_jacobian(w, section), _angular_jacobian(w)], axis=-2)


def spatial_twist_jacobian(phi: Array, theta: Array, section: Section) -> Array:
    """The matrix of Eq. 21, (..., 6, 2): spatial twist (v, omega) of the tip frame per rate of (phi, theta) [rad].

    The linear part is the velocity of the moving frame's point that passes the base origin, not of the tip.
    """
    phi, theta = np.asarray(phi, dtype=float), np.asarray(theta, dtype=float)
    w = allen_from_jones(phi, theta)
    geometric = section_jacobian(w, section) @ allen_rate_jacobian(phi, theta)
    linear, angular = geometric[..., :3, :], geometric[..., 3:, :]
    lever = np.cross(angular, section_position(w, section)[..., None], axisa=-2, axisb=-2, axisc=-2)
    return np.concatenate([linear - lever, angular], axis=-2)


def _position_jacobian(w: Array, section: Section) -> Array:
    u, v = w[..., 0], w[..., 1]
    theta = bend(w)
    half = 0.5 * theta
    chord, slope = chord_length(theta, section), chord_slope(theta, section)
    lateral = 0.5 * chord * sinc(half)
    # Slopes over theta: d f(theta) / d w = (f'(theta) / theta) w.
    lateral_slope = 0.5 * (slope * sinc(half) + 0.25 * chord * sinc_slope(half))
    axial_slope = slope * np.cos(half) - 0.25 * chord * sinc(half)
    rows = [
        [lateral_slope * u * v, lateral_slope * v * v + lateral],
        [-lateral_slope * u * u - lateral, -lateral_slope * u * v],
        [axial_slope * u, axial_slope * v],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _angular_jacobian(w: Array) -> Array:
    """First two columns of the left Jacobian of SO(3) at the rotation vector (u, v, 0)."""
    u, v = w[..., 0], w[..., 1]
    theta = bend(w)
    first, second = versine(theta), one_minus_sinc(theta)
    rows = [
        [1.0 - second * v * v, second * u * v],
        [second * u * v, 1.0 - second * u * u],
        [-first * v, first * u],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

"""Thesis Eqs. 20 and 21: velocity of a section's tip from the rates of its configuration. Printed: docs/errata.md."""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.configuration import allen_from_jones, allen_rate_jacobian
from continuum.kinematics.rigid import Entries3, vector
from continuum.kinematics.section.chord import chord_derivative, chord_length
from continuum.kinematics.section.eq04_pose import section_position
from continuum.kinematics.smooth_functions import Real, one_minus_sinc, sinc, sinc_derivative, versine


def position_jacobian(u: Real, v: Real, b: float, n_joints: int) -> tuple[Entries3, Entries3]:
    """Velocity of the tip point [m/rad] per rate of u, and per rate of v, at (u, v) [rad]; ``b`` [m]."""
    theta = np.hypot(u, v)
    half = 0.5 * theta
    chord, derivative = chord_length(theta, b, n_joints), chord_derivative(theta, b, n_joints)
    lateral = 0.5 * chord * sinc(half)
    # Slopes over theta: d f(theta) / d (u, v) = (f'(theta) / theta) (u, v).
    lateral_derivative = 0.5 * (derivative * sinc(half) + 0.25 * chord * sinc_derivative(half))
    axial_derivative = derivative * np.cos(half) - 0.25 * chord * sinc(half)
    along_u = (lateral_derivative * u * v, -lateral_derivative * u * u - lateral, axial_derivative * u)
    along_v = (lateral_derivative * v * v + lateral, -lateral_derivative * u * v, axial_derivative * v)
    return along_u, along_v


def rotation_jacobian(u: Real, v: Real) -> tuple[Entries3, Entries3]:
    """Angular velocity of the tip [rad/rad] per rate of u, and per rate of v, at (u, v) [rad].

    These are the first two columns of the left Jacobian of SO(3) at the rotation vector (u, v, 0).
    """
    theta = np.hypot(u, v)
    first, second = versine(theta), one_minus_sinc(theta)
    along_u = (1.0 - second * v * v, second * u * v, -first * v)
    along_v = (second * u * v, 1.0 - second * u * u, first * u)
    return along_u, along_v


def section_jacobian(w: Array, section: Section) -> Array:
    """Geometric Jacobian (..., 6, 2) of the tip at ``w`` (..., 2) [rad], in the section's base frame.

    Rows: linear velocity of the tip point [m/rad], then angular velocity [rad/rad]; columns: u, v.
    """
    u, v = w[..., 0], w[..., 1]
    linear = [vector(column) for column in position_jacobian(u, v, section.b, section.n_joints)]
    angular = [vector(column) for column in rotation_jacobian(u, v)]
    return np.concatenate([np.stack(linear, axis=-1), np.stack(angular, axis=-1)], axis=-2)


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

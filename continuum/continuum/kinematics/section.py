"""One section of constant curvature: configuration to pose and back, and the rates between them.

The section is a polygon of n_j + 1 links: b, 2b, ..., 2b, b. Bent evenly, its links make the angles
n_j x, (n_j - 2) x, ..., -n_j x with the chord, the straight line from the base disc to the tip disc, where
x = theta / (2 n_j); the chord itself leaves the base at theta / 2. So the chord is the sum of the links' projections,
for any bend, and no quotient needs a limit.

=================================  ==================================================
section_pose                       Eq. 4, FK_gen; entry (1,1) as printed is wrong: docs/errata.md
rotation_entries                   Eq. 4, rotation; section_rotation for arrays
position_entries                   Eq. 4, position; section_position for arrays
chord_length, chord_derivative     the chord in Eqs. 4 and 21
configuration_from_point           Eq. 5, IK_gen; configuration_entries for single points
section_jacobian                   Eq. 20, of the tip: position_jacobian and rotation_jacobian
spatial_twist_jacobian             Eqs. 20, 21; as printed: docs/errata.md
jones_from_point_jacobian          Eq. 22
configuration_from_point_jacobian  Eq. 22 for u and v
=================================  ==================================================
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial import polynomial

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.configuration import allen_from_jones, allen_rate_jacobian
from continuum.kinematics.rigid import Entries3, Entries9, matrix, transform, vector
from continuum.kinematics.smooth_functions import Real, one_minus_sinc, sinc, sinc_derivative, versine


def chord_length(theta: Real, b: float, n_joints: int) -> Real:
    """Chord [m] of Eq. 4: from base disc to tip disc, signed along theta / 2, at bend ``theta`` [rad]; ``b`` [m]."""
    total: Real = 2 * b * np.cos(0.5 * theta)  # the two half links at the ends
    for k in range(1, (n_joints + 1) // 2):  # pairs of links at equal angles on either side of the chord
        total = total + 4 * b * np.cos((0.5 - k / n_joints) * theta)
    if n_joints % 2 == 0:
        total = total + 2 * b  # the link in the middle, along the chord
    return total


def chord_derivative(theta: Real, b: float, n_joints: int) -> Real:
    """(d chord / d theta) / theta [m/rad^2] of Eq. 21, finite in the straight posture."""
    total = -0.5 * b * sinc(0.5 * theta)
    for k in range(1, (n_joints + 1) // 2):
        multiple = 0.5 - k / n_joints
        total = total - 4 * b * multiple * multiple * sinc(multiple * theta)
    return total


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
    """Rotation (..., 3, 3) of the tip frame in the base frame at ``w`` (..., 2) [rad]: Eq. 4."""
    return matrix(rotation_entries(w[..., 0], w[..., 1]))


def section_position(w: Array, section: Section) -> Array:
    """Position (..., 3) [m] of the tip disc in the base frame at ``w`` (..., 2) [rad]: Eq. 4."""
    return vector(position_entries(w[..., 0], w[..., 1], section.b, section.n_joints))


def section_pose(w: Array, section: Section) -> Array:
    """Transform (..., 4, 4) [m] from the tip frame D to the base frame P at ``w`` (..., 2) [rad]: Eq. 4, FK_gen."""
    return transform(section_rotation(w), section_position(w, section))


def configuration_entries(x: Real, y: Real, z: Real) -> tuple[Real, Real]:
    """Eq. 5 without its case split: (u, v) [rad] of a section whose tip lies in the direction (x, y, z)."""
    radius = np.hypot(x, y)
    theta = 2.0 * np.arctan2(radius, z)
    safe_radius = radius + (radius == 0.0)
    return -theta * (y / safe_radius), theta * (x / safe_radius)


def configuration_from_point(point: Array) -> Array:
    """Configuration ``w`` (..., 2) [rad] of a section whose tip lies in the direction of ``point`` (..., 3) [m]: Eq. 5.

    For an inextensible section this is a projection: only the direction of the point is used.
    theta = 2 atan2(hypot(x, y), z), phi = atan2(y, x). Below the base plane theta exceeds 180 degrees. Straight down
    (x = y = 0, z < 0) the azimuth is arbitrary; w is (0, 0) there and at the origin, which has no direction.
    """
    return np.stack(configuration_entries(point[..., 0], point[..., 1], point[..., 2]), axis=-1)


def position_jacobian(u: Real, v: Real, b: float, n_joints: int) -> tuple[Entries3, Entries3]:
    """Eq. 20: velocity of the tip point [m/rad] per rate of u, and per rate of v, at (u, v) [rad]; ``b`` [m]."""
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
    """Eq. 20: angular velocity of the tip [rad/rad] per rate of u, and per rate of v, at (u, v) [rad].

    These are the first two columns of the left Jacobian of SO(3) at the rotation vector (u, v, 0).
    """
    theta = np.hypot(u, v)
    first, second = versine(theta), one_minus_sinc(theta)
    along_u = (1.0 - second * v * v, second * u * v, -first * v)
    along_v = (second * u * v, 1.0 - second * u * u, first * u)
    return along_u, along_v


def section_jacobian(w: Array, section: Section) -> Array:
    """Geometric Jacobian (..., 6, 2) of the tip at ``w`` (..., 2) [rad], in the section's base frame: Eq. 20.

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


_SMALL = 0.05  # radius over height of a point near the axis, where Eq. 22 would subtract nearly equal numbers
_SERIES = (-4 / 3, 8 / 5, -12 / 7, 16 / 9, -20 / 11, 24 / 13)


def jones_from_point_jacobian(point: Array) -> Array:
    """d(phi, theta) / d(x, y, z), (..., 2, 3) [rad/m], at ``point`` (..., 3) [m]: Eq. 22 as printed.

    Not finite on the z axis, where phi is not defined; :func:`configuration_from_point_jacobian` is finite for z > 0.
    """
    x, y, z = point[..., 0], point[..., 1], point[..., 2]
    radius, distance_squared = np.hypot(x, y), np.sum(point * point, axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        phi_row = [-y / radius**2, x / radius**2, np.zeros_like(x)]
        theta_row = [2 * x * z / radius, 2 * y * z / radius, -2 * radius]
    theta_row = [entry / distance_squared for entry in theta_row]
    return np.stack([np.stack(phi_row, axis=-1), np.stack(theta_row, axis=-1)], axis=-2)


def configuration_from_point_jacobian(point: Array) -> Array:
    """d(u, v) / d(x, y, z), (..., 2, 3) [rad/m], at ``point`` (..., 3) [m]: Eq. 22, regular in the straight posture.

    With r = hypot(x, y) and f = theta / r: (u, v) = f (-y, x), so only the derivative of f by r needs care.
    Not finite straight down (x = y = 0, z <= 0), where the configuration is discontinuous.
    """
    x, y, z = point[..., 0], point[..., 1], point[..., 2]
    radius, distance_squared = np.hypot(x, y), np.sum(point * point, axis=-1)
    near_axis = (radius < _SMALL * np.abs(z)) & (z > 0.0)
    safe_z, safe_radius = np.where(near_axis, z, 1.0), np.where(near_axis, 1.0, radius)
    theta = 2.0 * np.arctan2(radius, z)
    with np.errstate(divide="ignore", invalid="ignore"):
        per_radius = np.where(near_axis, 2.0 * _atan_ratio(radius / safe_z) / safe_z, theta / safe_radius)
        derivative = np.where(
            near_axis,
            polynomial.polyval((radius / safe_z) ** 2, _SERIES) / safe_z**3,
            (2.0 * z * radius / distance_squared - theta) / safe_radius**3,
        )
        along_z = -2.0 / distance_squared
    rows = [
        [-derivative * x * y, -derivative * y * y - per_radius, -along_z * y],
        [derivative * x * x + per_radius, derivative * x * y, along_z * x],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _atan_ratio(t: Array) -> Array:
    """atan(t) / t."""
    zero = t == 0.0
    return np.where(zero, 1.0, np.arctan(t) / np.where(zero, 1.0, t))

"""Configuration of a section: Allen's (u, v), Jones's (phi, kappa, s) and the bend theta between them.

Everywhere in the library ``w`` is Allen's pair (u, v) [rad], the x and y parts of the section's rotation vector: it is
regular in the straight posture, where Jones's azimuth phi is not defined (Allen et al. 2020; Jones and Walker 2006).

=======================  ============================================================
bend                     Eq. 1
jones_from_allen         Eqs. 1, 2
allen_from_jones         Eq. 3
arc_length               Eq. 6
curvature                Eq. 7
allen_rate_jacobian      Eq. 23, its matrix
allen_rates              Eq. 23
jones_rates              Eq. 23, solved for the rates of phi and theta
arc_rates                Eq. 24; the printed first row is wrong: docs/errata.md
=======================  ============================================================
"""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.smooth_functions import one_minus_sinc, sinc


def bend(w: Array) -> Array:
    """Total bend theta [rad] (...) of configurations ``w`` (..., 2) [rad]: Eq. 1, theta = hypot(u, v)."""
    return np.hypot(w[..., 0], w[..., 1])


def jones_from_allen(w: Array) -> tuple[Array, Array]:
    """Azimuth phi in (-pi, pi] and bend theta >= 0 [rad] of ``w`` (..., 2) [rad]: Eqs. 1 and 2.

    phi = atan2(-u, v); it is 0 in the straight posture, where the azimuth is arbitrary.
    """
    u, v = w[..., 0], w[..., 1]
    return np.arctan2(0.0 - u, 0.0 + v), bend(w)


def allen_from_jones(phi: Array | float, theta: Array | float) -> Array:
    """Allen's ``w`` (..., 2) [rad] of azimuth and bend [rad]: Eq. 3, (u, v) = theta (-sin phi, cos phi)."""
    return np.stack([-theta * np.sin(phi), theta * np.cos(phi)], axis=-1)


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


def allen_rate_jacobian(phi: Array, theta: Array) -> Array:
    """d(u, v) / d(phi, theta), (..., 2, 2), at azimuth and bend (...) [rad]: the matrix of Eq. 23."""
    c, s = np.cos(phi), np.sin(phi)
    return np.stack([np.stack([-theta * c, -s], axis=-1), np.stack([-theta * s, c], axis=-1)], axis=-2)


def allen_rates(phi: Array, theta: Array, phi_rate: Array, theta_rate: Array) -> Array:
    """Rate of ``w`` (..., 2) [rad/s] from azimuth, bend [rad] and their rates [rad/s], each (...): Eq. 23."""
    rates = np.stack([np.asarray(phi_rate, dtype=float), np.asarray(theta_rate, dtype=float)], axis=-1)
    jacobian = allen_rate_jacobian(np.asarray(phi, dtype=float), np.asarray(theta, dtype=float))
    w_rate: Array = (jacobian @ rates[..., None])[..., 0]
    return w_rate


def jones_rates(w: Array, w_rate: Array) -> tuple[Array, Array]:
    """Rates of phi and theta [rad/s], each (...), from ``w`` (..., 2) [rad] and its rate [rad/s]: Eq. 23, solved.

    In the straight posture the section starts to bend in the direction of the rate: theta grows at the norm of the
    rate. The limit of phi's rate does not exist there; 0 is returned, to match the constant phi = 0 of
    :func:`jones_from_allen`.
    """
    phi, theta = jones_from_allen(w)
    straight = theta == 0.0
    c, s = np.cos(phi), np.sin(phi)
    u_rate, v_rate = w_rate[..., 0], w_rate[..., 1]
    theta_rate = np.where(straight, np.hypot(u_rate, v_rate), -s * u_rate + c * v_rate)
    phi_rate = np.where(straight, 0.0, -(c * u_rate + s * v_rate) / np.where(straight, 1.0, theta))
    return phi_rate, theta_rate


def arc_rates(theta: Array, theta_rate: Array, section: Section) -> tuple[Array, Array]:
    """Eq. 24: rates of curvature [1/(m s)] and arc length [m/s], each (...); ``theta`` [rad], ``theta_rate`` [rad/s].

    d kappa / d theta = (kappa^2 b + 1 / b) / (2 n_j);
    d s / d theta = b (cos x sin x - x) / sin^2 x with x = theta / (2 n_j), in a form that is regular at x = 0.
    """
    x = np.asarray(theta, dtype=float) / (2 * section.n_joints)
    kappa = curvature(np.asarray(theta, dtype=float), section)
    kappa_derivative = (kappa**2 * section.b + 1 / section.b) / (2 * section.n_joints)
    arc_derivative = -4 * section.b * x * one_minus_sinc(2 * x) / sinc(x) ** 2
    return kappa_derivative * theta_rate, arc_derivative * theta_rate

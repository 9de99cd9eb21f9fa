"""Thesis Eq. 23: rates of Allen's (u, v) and of Jones's (phi, theta), both ways."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.configuration.eq01_allen_and_jones import jones_from_allen


def allen_rate_jacobian(phi: Array, theta: Array) -> Array:
    """d(u, v) / d(phi, theta), (..., 2, 2), at azimuth and bend (...) [rad]: the matrix of Eq. 23."""
    c, s = np.cos(phi), np.sin(phi)
    return np.stack([np.stack([-theta * c, -s], axis=-1), np.stack([-theta * s, c], axis=-1)], axis=-2)


def allen_rates(phi: Array, theta: Array, phi_rate: Array, theta_rate: Array) -> Array:
    """Rate of ``w`` (..., 2) [rad/s] from azimuth, bend [rad] and their rates [rad/s], each (...)."""
    rates = np.stack([np.asarray(phi_rate, dtype=float), np.asarray(theta_rate, dtype=float)], axis=-1)
    jacobian = allen_rate_jacobian(np.asarray(phi, dtype=float), np.asarray(theta, dtype=float))
    w_rate: Array = (jacobian @ rates[..., None])[..., 0]
    return w_rate


def jones_rates(w: Array, w_rate: Array) -> tuple[Array, Array]:
    """Rates of phi and theta [rad/s], each (...), from ``w`` (..., 2) [rad] and its rate [rad/s].

    In the straight posture the section starts to bend towards the rate: theta grows by its norm and phi, which
    :func:`jones_from_allen` says is 0 there, is not moving. The limit of phi's rate does not exist there.
    """
    phi, theta = jones_from_allen(w)
    straight = theta == 0.0
    c, s = np.cos(phi), np.sin(phi)
    u_rate, v_rate = w_rate[..., 0], w_rate[..., 1]
    theta_rate = np.where(straight, np.hypot(u_rate, v_rate), -s * u_rate + c * v_rate)
    phi_rate = np.where(straight, 0.0, -(c * u_rate + s * v_rate) / np.where(straight, 1.0, theta))
    return phi_rate, theta_rate

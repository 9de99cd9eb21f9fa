"""Thesis Eq. 24: rates of curvature and arc length with the bend. The printed first row is wrong: docs/errata.md."""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.configuration.eq06_arc import curvature
from continuum.kinematics.smooth_functions import one_minus_sinc, sinc


def arc_rates(theta: Array, theta_rate: Array, section: Section) -> tuple[Array, Array]:
    """Rates of curvature [1/(m s)] and arc length [m/s], each (...), at ``theta`` [rad], ``theta_rate`` [rad/s].

    d kappa / d theta = (kappa^2 b + 1 / b) / (2 n_j);
    d s / d theta = b (cos x sin x - x) / sin^2 x with x = theta / (2 n_j), written so that x = 0 is no exception.
    """
    x = np.asarray(theta, dtype=float) / (2 * section.n_joints)
    kappa = curvature(np.asarray(theta, dtype=float), section)
    kappa_derivative = (kappa**2 * section.b + 1 / section.b) / (2 * section.n_joints)
    arc_derivative = -4 * section.b * x * one_minus_sinc(2 * x) / sinc(x) ** 2
    return kappa_derivative * theta_rate, arc_derivative * theta_rate

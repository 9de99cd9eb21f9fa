"""Thesis Eq. 12, C: Coriolis and centripetal matrix with Christoffel symbols, so that dM/dt - 2 C is skew.

In the links' absolute angles C_ij = A_ij sin(phi_i - phi_j) phi_j'; in joint space L^T C L.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.eq12_inertia_matrix import joint_space
from continuum.dynamics.planar.link_coupling import coupling_times, link_coupling


def coriolis_matrix(link_angle: Numbers, link_rate: Numbers, p: Parameters) -> Numbers:
    """C(theta, theta'), (n, n) [N m s/rad].

    Args:
        link_angle, link_rate: of each link, absolute, (n,) [rad, rad/s].
        p: parameters.
    """
    return joint_space(link_coriolis_matrix(link_angle, link_rate, p))


def link_coriolis_matrix(link_angle: Numbers, link_rate: Numbers, p: Parameters) -> Numbers:
    """The same in the links' absolute angles, (n, n) [N m s/rad]."""
    return link_coupling(p) * np.sin(link_angle[:, None] - link_angle[None, :]) * link_rate


def link_coriolis_torque(link_angle: Numbers, link_rate: Numbers, p: Parameters) -> Numbers:
    """The latter matrix times the rates, (n,) [N m]; without the matrix, as `link_inertia_times`."""
    c, s = np.cos(link_angle), np.sin(link_angle)
    return s * coupling_times(c * link_rate**2, p) - c * coupling_times(s * link_rate**2, p)

"""Thesis Eq. 12, G: torque of gravity at the joints, for any mounting of the base.

The potential is V = -g sum_i (m_i c_i + d_i sum_k>i m_k) cos(beta + phi_i) with beta from the direction of gravity to
the straight arm: 0 hangs, pi stands.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, suffix_sum
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.link_coupling import mass_moments


def gravity_torque(link_angle: Numbers, p: Parameters) -> Numbers:
    """G(theta) = dV/dtheta, (n,) [N m].

    Args:
        link_angle: absolute angle of each link, (n,) [rad].
        p: parameters.
    """
    return suffix_sum(link_gravity_torque(link_angle, p))


def link_gravity_torque(link_angle: Numbers, p: Parameters) -> Numbers:
    """dV/dphi of each link's absolute angle, (n,) [N m]."""
    return p.gravity * mass_moments(p) * np.sin(p.hang_angle + link_angle)


def gravity_potential(link_angle: Numbers, p: Parameters) -> Numbers:
    """V, (1,) [J]; zero with every link level."""
    return -p.gravity * np.sum(mass_moments(p) * np.cos(p.hang_angle + link_angle))

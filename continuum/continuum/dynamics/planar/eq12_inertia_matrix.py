"""Thesis Eq. 12, M: generalised inertia of the planar chain in joint space (Murray, Li and Sastry 1994, ch. 4).

With link angles phi = L theta, L lower triangular of ones: M = L^T (A o cos(phi_i - phi_j) + diag(I)) L. The product
with a vector needs no matrix: cos(phi_i - phi_j) = c_i c_j + s_i s_j, so the masses' accelerations along x and z are
added up, which is most of what makes long arms cheap. Rotors of the drives stand on the diagonal, `eq12_rotor_torque`.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, suffix_sum
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.link_coupling import coupling_times, link_coupling


def inertia_matrix(link_angle: Numbers, p: Parameters) -> Numbers:
    """M(theta), (n, n) [kg m2], symmetric and positive definite.

    Args:
        link_angle: absolute angle of each link, (n,) [rad].
        p: parameters.
    """
    return joint_space(link_inertia_matrix(link_angle, p)) + np.diag(p.rotor_inertia)


def link_inertia_matrix(link_angle: Numbers, p: Parameters) -> Numbers:
    """That of the links alone in their absolute angles, (n, n) [kg m2]."""
    return link_coupling(p) * np.cos(link_angle[:, None] - link_angle[None, :]) + np.diag(p.inertia)


def link_inertia_times(link_angle: Numbers, vector: Numbers, p: Parameters) -> Numbers:
    """The latter matrix times a vector, (n,)."""
    c, s = np.cos(link_angle), np.sin(link_angle)
    return c * coupling_times(c * vector, p) + s * coupling_times(s * vector, p) + p.inertia * vector


def joint_space(matrix: Numbers) -> Numbers:
    """L^T matrix L: from absolute link angles to relative joint angles, (n, n)."""
    return suffix_sum(suffix_sum(matrix).T).T

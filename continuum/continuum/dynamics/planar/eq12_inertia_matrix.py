"""Thesis Eq. 12, M: generalised inertia of the planar chain in joint space (Murray, Li and Sastry 1994, ch. 4).

With link angles phi = L theta, L lower triangular of ones: M = L^T (A o cos(phi_i - phi_j) + diag(I)) L.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, suffix_sum
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.link_coupling import link_coupling


def inertia_matrix(link_angle: Numbers, p: Parameters) -> Numbers:
    """M(theta), (n, n) [kg m2], symmetric and positive definite.

    Args:
        link_angle: absolute angle of each link, (n,) [rad].
        p: parameters.
    """
    return joint_space(link_inertia_matrix(link_angle, p))


def link_inertia_matrix(link_angle: Numbers, p: Parameters) -> Numbers:
    """The same in the links' absolute angles, (n, n) [kg m2]."""
    return link_coupling(p) * np.cos(link_angle[:, None] - link_angle[None, :]) + np.diag(p.inertia)


def joint_space(matrix: Numbers) -> Numbers:
    """L^T matrix L: from absolute link angles to relative joint angles, (n, n)."""
    return suffix_sum(suffix_sum(matrix).T).T

"""How masses couple the links of a planar chain: A of the energy (1/2) sum_ij A_ij cos(phi_i - phi_j) phi_i' phi_j'.

Mass k moves with link i through the lever rho_ki: the link's length d_i where i < k, its own c_k where i = k. Hence
A_ij = sum over k >= max(i, j) of m_k rho_ki rho_kj, a constant of the arm.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, suffix_sum
from continuum.dynamics.parameters import Parameters


def link_coupling(p: Parameters) -> Numbers:
    """A, (n, n) [kg m2], without the links' own inertias."""
    n, d = p.n_joints, p.joint_spacing
    moment = mass_moments(p)
    A = np.empty((n, n), dtype=moment.dtype)
    outboard = suffix_sum(p.mass) - p.mass
    for i in range(n):
        A[i, i] = p.mass[i] * p.center_of_mass[i] ** 2 + outboard[i] * d[i] ** 2
        A[i, i + 1 :] = A[i + 1 :, i] = moment[i + 1 :] * d[i : i + 1]
    return A


def mass_moments(p: Parameters) -> Numbers:
    """First moment of what link i carries, m_i c_i + d_i times all mass beyond it, (n,) [kg m]."""
    return p.mass * p.center_of_mass + (suffix_sum(p.mass) - p.mass) * p.joint_spacing


def coupling_times(vector: Numbers, p: Parameters) -> Numbers:
    """A times a vector, (n,): by sums along the arm, n operations and no matrix."""
    moment, d = mass_moments(p), p.joint_spacing
    outboard = suffix_sum(p.mass) - p.mass
    beyond, before = suffix_sum(moment * vector) - moment * vector, np.cumsum(d * vector) - d * vector
    return (p.mass * p.center_of_mass**2 + outboard * d**2) * vector + d * beyond + moment * before

"""Thesis Eq. 12, M, C and G: inertia, Coriolis terms and gravity of a planar chain (Murray, Li, Sastry 1994, ch. 4).

Mass k moves with link i through the lever rho_ki: the length d_i of the link for i < k, and c_k for i = k. The energy
is therefore (1/2) sum_ij A_ij cos(phi_i - phi_j) phi_i' phi_j' with A_ij = sum over k >= max(i, j) of m_k rho_ki
rho_kj, a constant of the arm. With link angles phi = L theta, where L is the lower triangular matrix of ones,

    M = L^T (A o cos(phi_i - phi_j) + diag(I)) L,    C = L^T (A o sin(phi_i - phi_j) diag(phi')) L,

and C consists of Christoffel symbols, so that dM/dt - 2 C is skew-symmetric. The products with a vector need no matrix:
cos(phi_i - phi_j) = c_i c_j + s_i s_j, so the masses' accelerations along x and z are added up, which accounts for most
of the efficiency for long arms. The potential of gravity is V = -g sum_i (m_i c_i + d_i sum_k>i m_k) cos(beta + phi_i)
with beta from the direction of gravity to the straight arm: the arm hangs for 0 and stands upright for pi.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, suffix_sum
from continuum.dynamics.parameters import Parameters


def link_coupling(p: Parameters) -> Numbers:
    """A, (n, n) [kg m2], without the links' inertias about their centres of mass."""
    n, d = p.n_joints, p.joint_spacing
    moment = mass_moments(p)
    A = np.empty((n, n), dtype=moment.dtype)
    outboard = suffix_sum(p.mass) - p.mass
    for i in range(n):
        A[i, i] = p.mass[i] * p.center_of_mass[i] ** 2 + outboard[i] * d[i] ** 2
        A[i, i + 1 :] = A[i + 1 :, i] = moment[i + 1 :] * d[i : i + 1]
    return A


def mass_moments(p: Parameters) -> Numbers:
    """First moment of the mass on link i, m_i c_i + d_i times all mass beyond it, (n,) [kg m]."""
    return p.mass * p.center_of_mass + (suffix_sum(p.mass) - p.mass) * p.joint_spacing


def coupling_times(vector: Numbers, p: Parameters) -> Numbers:
    """A times a vector, (n,), by cumulative sums along the arm: of order n operations and no matrix."""
    moment, d = mass_moments(p), p.joint_spacing
    outboard = suffix_sum(p.mass) - p.mass
    beyond, before = suffix_sum(moment * vector) - moment * vector, np.cumsum(d * vector) - d * vector
    return (p.mass * p.center_of_mass**2 + outboard * d**2) * vector + d * beyond + moment * before


def inertia_matrix(link_angle: Numbers, p: Parameters) -> Numbers:
    """M(theta) of Eq. 12, (n, n) [kg m2], symmetric and positive definite; rotor inertias are on its diagonal.

    Args:
        link_angle: absolute angle of each link, (n,) [rad].
        p: parameters.
    """
    return joint_space(link_inertia_matrix(link_angle, p)) + np.diag(p.rotor_inertia)


def link_inertia_matrix(link_angle: Numbers, p: Parameters) -> Numbers:
    """M of the links alone in their absolute angles, (n, n) [kg m2]."""
    return link_coupling(p) * np.cos(link_angle[:, None] - link_angle[None, :]) + np.diag(p.inertia)


def link_inertia_times(link_angle: Numbers, vector: Numbers, p: Parameters) -> Numbers:
    """`link_inertia_matrix` times a vector, (n,), without forming the matrix."""
    c, s = np.cos(link_angle), np.sin(link_angle)
    return c * coupling_times(c * vector, p) + s * coupling_times(s * vector, p) + p.inertia * vector


def joint_space(matrix: Numbers) -> Numbers:
    """L^T matrix L: convert a matrix from absolute link angles to relative joint angles, (n, n)."""
    return suffix_sum(suffix_sum(matrix).T).T


def rotor_torque(theta_acceleration: Numbers, p: Parameters) -> Numbers:
    """J_r theta'', (n,) [N m], for joint accelerations (n,) [rad/s2]: part of M in Eq. 12, beyond the thesis.

    J_r is the inertia of the rotor times the gear ratio squared, and acts at the relative acceleration of its joint.
    The model neglects that the rotor also rotates with the link that carries it, which contributes a fraction of
    1 / (gear ratio) of this torque.
    """
    return p.rotor_inertia * theta_acceleration


def coriolis_matrix(link_angle: Numbers, link_rate: Numbers, p: Parameters) -> Numbers:
    """C(theta, theta') of Eq. 12, (n, n) [N m s/rad].

    Args:
        link_angle, link_rate: absolute angle and rate of each link, (n,) [rad, rad/s].
        p: parameters.
    """
    return joint_space(link_coriolis_matrix(link_angle, link_rate, p))


def link_coriolis_matrix(link_angle: Numbers, link_rate: Numbers, p: Parameters) -> Numbers:
    """C in the links' absolute angles, A_ij sin(phi_i - phi_j) phi_j', (n, n) [N m s/rad]."""
    return link_coupling(p) * np.sin(link_angle[:, None] - link_angle[None, :]) * link_rate


def link_coriolis_torque(link_angle: Numbers, link_rate: Numbers, p: Parameters) -> Numbers:
    """`link_coriolis_matrix` times the rates, (n,) [N m], without forming the matrix."""
    c, s = np.cos(link_angle), np.sin(link_angle)
    return s * coupling_times(c * link_rate**2, p) - c * coupling_times(s * link_rate**2, p)


def gravity_torque(link_angle: Numbers, p: Parameters) -> Numbers:
    """G(theta) = dV/dtheta of Eq. 12, (n,) [N m].

    Args:
        link_angle: absolute angle of each link, (n,) [rad].
        p: parameters.
    """
    return suffix_sum(link_gravity_torque(link_angle, p))


def link_gravity_torque(link_angle: Numbers, p: Parameters) -> Numbers:
    """dV/dphi of each link's absolute angle, (n,) [N m]."""
    return p.gravity * mass_moments(p) * np.sin(p.hang_angle + link_angle)


def gravity_potential(link_angle: Numbers, p: Parameters) -> Numbers:
    """V, (1,) [J]; zero if every link is horizontal."""
    return -p.gravity * np.sum(mass_moments(p) * np.cos(p.hang_angle + link_angle))

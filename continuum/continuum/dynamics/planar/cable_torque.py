"""The torque J_s^T W B u of the cables at the joints of a planar section: Eqs. 12, 16 and 17."""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, positive_part, suffix_sum
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.dynamics.planar.capstan_law import tension_propagation
from continuum.dynamics.planar.instant import Motion


def cable_torque(move: Motion, u: Numbers, p: Parameters) -> Numbers:
    """Right-hand side of Eq. 12, J_s^T W B u, (n,) [N m]; zero for an arm without cables.

    Args:
        move: motion of the joints and links.
        u: tension of each cable at the base, (n_cables,) [N]; values below 0 count as 0, because a cable cannot push.
        p: parameters.
    """
    if not p.has_cables:
        return np.zeros(p.n_joints)
    local = tension_propagation(move.theta, move.slip_rate, p) * positive_part(u)
    return serial_jacobian_transposed_times(link_wrenches(local, move.theta, p), move.link_angle, p)


def link_wrenches(tensions: Numbers, theta: Numbers, p: Parameters) -> Numbers:
    """Eq. 16, W T: (F_x, F_z, M) on each link, at its disc's centre, in its own frame, (n, 3) [N, N, N m].

    A cable pulls a disc backwards along the chord of module i and forwards along that of module i + 1. By symmetry a
    chord is parallel to the bisector of its two links, so it is inclined by half the joint's angle. In contrast to the
    printed matrix, the signs are those of this plane (z along the link, moments from z to x); a test verifies that
    J_s^T W B u is the virtual work of the cables. A link longer than b_i + b_(i+1) has two discs; the wrench at the
    further disc is expressed at the nearer one.

    Args:
        tensions: T = B u, the tension of each cable in each module, (n, n_cables) [N].
        theta: angles of the joints, (n,) [rad].
        p: parameters.
    """
    sine, cosine, a = np.sin(theta / 2), np.cos(theta / 2), p.hole_radius
    pull = tensions.sum(axis=1)
    twist = (tensions * SIDES).sum(axis=1)
    module = np.stack([pull * sine, pull * cosine, twist * a * cosine], axis=1)
    beyond = np.concatenate([module[1:], np.zeros((1, 3))])  # the cables end at the last disc
    further = p.disc_gap * beyond[:, 0]  # the gap lengthens the lever
    at_disc = np.stack([np.zeros_like(further), np.zeros_like(further), further], axis=1)
    return module * np.array([1.0, -1.0, 1.0]) + beyond * np.array([1.0, 1.0, -1.0]) + at_disc


def serial_jacobian_transposed_times(wrenches: Numbers, link_angle: Numbers, p: Parameters) -> Numbers:
    """Eq. 17, J_s^T F for wrenches at the discs' centres in the frames of the links, (n,) [N m].

    Joint k moves disc i >= k perpendicularly to the lever from the joint to the disc. The function evaluates the
    product with the block matrix as a sum: the forces beyond a joint act on it through the link of that joint.

    Args:
        wrenches: (F_x, F_z, M) of each link, (n, 3) [N, N, N m].
        link_angle: absolute angle of each link, (n,) [rad].
        p: parameters.
    """
    force = turned(wrenches[:, :2], link_angle)
    beyond = suffix_sum(force) - force
    across = np.stack([np.cos(link_angle), -np.sin(link_angle)], axis=1)  # d(sin, cos) / d angle
    lever_work = p.middle * (across * force).sum(axis=1) + p.joint_spacing * (across * beyond).sum(axis=1)
    return suffix_sum(lever_work + wrenches[:, 2])


def turned(vectors: Numbers, angle: Numbers) -> Numbers:
    """Rotate vectors (n, 2) in (x, z), each by its angle (n,) [rad] from z towards x."""
    x, z = vectors[:, 0], vectors[:, 1]
    return np.stack([np.cos(angle) * x + np.sin(angle) * z, np.cos(angle) * z - np.sin(angle) * x], axis=1)


def serial_jacobian(link_angle: Numbers, p: Parameters) -> Numbers:
    """Eq. 17, J_s, (3 n, n): motion (x, z, angle) of every disc, in its link's frame, for a unit rate of every joint.

    As printed, it is block upper triangular.
    """
    n = p.n_joints
    unit = np.eye(3 * n).reshape(3 * n, n, 3)
    return np.stack([serial_jacobian_transposed_times(wrench, link_angle, p) for wrench in unit])

"""Thesis Eq. 17, J_s: from wrenches on the links, at their discs' centres, to torques at the joints.

Joint k moves disc i >= k by the lever from the joint to the disc, across it; upper triangular by blocks, as printed.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, suffix_sum
from continuum.dynamics.parameters import Parameters


def serial_jacobian_transposed_times(wrenches: Numbers, link_angle: Numbers, p: Parameters) -> Numbers:
    """J_s^T F of wrenches in the links' own frames, (n,) [N m].

    Written as the sum that the block matrix means: what lies beyond a joint pushes on it through that joint's link.

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
    """Vectors (n, 2) in (x, z), each turned by its angle (n,) [rad] from z towards x."""
    x, z = vectors[:, 0], vectors[:, 1]
    return np.stack([np.cos(angle) * x + np.sin(angle) * z, np.cos(angle) * z - np.sin(angle) * x], axis=1)


def serial_jacobian(link_angle: Numbers, p: Parameters) -> Numbers:
    """J_s, (3 n, n): motion (x, z, angle) of every disc, in its link's frame, for a unit rate of every joint."""
    n = p.n_joints
    unit = np.eye(3 * n).reshape(3 * n, n, 3)
    return np.stack([serial_jacobian_transposed_times(wrench, link_angle, p) for wrench in unit])

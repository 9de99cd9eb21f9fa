"""Poses of the discs when the joints of a section bend by different angles, as those of a real arm do.

The bend of a joint is Allen's (u, v) of that joint alone. The bends of one section lie in one plane, and their sum is
the section's configuration. In an evenly bent section each bend is the sum divided by n_joints, and the discs lie on
the arc of Eq. 4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from continuum.arm import Arm, Section
from continuum.arrays import Array
from continuum.kinematics.rigid import IDENTITY, matrix, transform, turned_about_z
from continuum.kinematics.section import section_pose


def even_bends(w: Array, section: Section) -> Array:
    """Return equal bends (..., n_joints, 2) [rad] of the joints of a section at ``w`` (..., 2) [rad]."""
    return np.repeat(w[..., None, :] / section.n_joints, section.n_joints, axis=-2)


def disc_poses(bends: Array, section: Section) -> Array:
    """Poses (..., n_joints + 1, 4, 4) [m] of a section's discs in its base frame, from the base disc to the tip disc.

    Args:
        bends: of the joints from the base, (..., n_joints, 2) [rad].
        section: the section.
    """
    joint = replace(section, n_joints=1, bend_limit=section.bend_limit / section.n_joints)
    steps = section_pose(bends, joint)
    poses = [np.broadcast_to(np.eye(4), steps[..., 0, :, :].shape)]
    for k in range(section.n_joints):
        poses.append(poses[-1] @ steps[..., k, :, :])
    return np.stack(poses, axis=-3)


def arm_disc_poses(bends: Sequence[Array], arm: Arm) -> list[Array]:
    """Return for each section the poses (n_joints + 1, 4, 4) [m] of its discs in ``base_link``.

    Args:
        bends: for each section the bends of its joints, (n_joints, 2) [rad].
        arm: the arm.
    """
    found: list[Array] = []
    tip = np.eye(4)
    for section, bent in zip(arm.sections, bends, strict=True):
        twist = matrix(turned_about_z(IDENTITY, np.cos(section.twist), np.sin(section.twist)))
        found.append(tip @ transform(twist, np.zeros(3)) @ disc_poses(bent, section))
        tip = found[-1][-1]
    return found

"""Thesis Eq. 10, FK_cart: poses along the arm in its base frame."""

from __future__ import annotations

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.rigid import rotation_about_z, turn_about_z
from continuum.kinematics.section import section_pose


def section_tip_poses(w: Array, arm: Arm) -> Array:
    """Poses (..., n_sections, 4, 4) of the sections' tips in ``base_link`` at ``w`` (..., n_sections, 2) [rad]."""
    pose: Array = np.eye(4)
    poses = []
    for i, section in enumerate(arm.sections):
        pose = pose @ turn_about_z(section.twist) @ section_pose(w[..., i, :], section)
        poses.append(pose)
    return np.stack(poses, axis=-3)


def arm_pose(w: Array, arm: Arm) -> Array:
    """Pose (..., 4, 4) of the arm's tip in ``base_link`` at ``w`` (..., n_sections, 2) [rad]; lengths in m."""
    return section_tip_poses(w, arm)[..., -1, :, :]


def section_base_rotations(tip_poses: Array, arm: Arm) -> Array:
    """Rotations (..., n_sections, 3, 3) of the sections' base frames, twist included, from the sections' tip poses."""
    before = np.concatenate(
        [np.broadcast_to(np.eye(3), tip_poses[..., :1, :3, :3].shape), tip_poses[..., :-1, :3, :3]], axis=-3
    )
    return before @ np.stack([rotation_about_z(section.twist) for section in arm.sections])

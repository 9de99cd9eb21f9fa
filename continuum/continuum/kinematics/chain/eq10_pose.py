"""Thesis Eq. 10, FK_cart: poses along the arm in its base frame."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.rigid import (
    IDENTITY,
    Entries3,
    Entries9,
    entries_of,
    matrix,
    product,
    rotated,
    transform,
    turned_about_z,
    vector,
)
from continuum.kinematics.section.eq04_pose import position_entries, rotation_entries


def next_tip(base: Entries9, position: Entries3, u: Any, v: Any, b: float, n_joints: int) -> tuple[Entries9, Entries3]:
    """Rotation and position [m] of a section's tip, from those of its base, twist included; u, v [rad], ``b`` [m]."""
    step = rotated(base, position_entries(u, v, b, n_joints))
    tip = (position[0] + step[0], position[1] + step[1], position[2] + step[2])
    return product(base, rotation_entries(u, v)), tip


def along_the_arm(w: Array, arm: Arm) -> Iterator[tuple[Entries9, Entries9, Entries3]]:
    """For every section: rotation of its base (twist included), rotation and position of its tip, in ``base_link``."""
    rotation: Entries9 = IDENTITY
    position: Entries3 = (0.0, 0.0, 0.0)
    for i, section in enumerate(arm.sections):
        base = turned_about_z(rotation, np.cos(section.twist), np.sin(section.twist))
        rotation, position = next_tip(base, position, w[..., i, 0], w[..., i, 1], section.b, section.n_joints)
        yield base, rotation, position


def section_tip_poses(w: Array, arm: Arm) -> Array:
    """Poses (..., n_sections, 4, 4) of the sections' tips in ``base_link`` at ``w`` (..., n_sections, 2) [rad]."""
    poses = [transform(matrix(rotation), vector(position)) for _, rotation, position in along_the_arm(w, arm)]
    return np.stack(poses, axis=-3)


def arm_pose(w: Array, arm: Arm) -> Array:
    """Pose (..., 4, 4) of the arm's tip in ``base_link`` at ``w`` (..., n_sections, 2) [rad]; lengths in m."""
    *_, (_, rotation, position) = along_the_arm(w, arm)
    return transform(matrix(rotation), vector(position))


def section_base_rotations(tip_poses: Array, arm: Arm) -> Array:
    """Rotations (..., n_sections, 3, 3) of the sections' base frames, twist included, from the sections' tip poses."""
    upright = np.broadcast_to(np.eye(3), tip_poses[..., :1, :3, :3].shape)
    before = np.concatenate([upright, tip_poses[..., :-1, :3, :3]], axis=-3)
    twists = np.array([section.twist for section in arm.sections])
    return matrix(turned_about_z(entries_of(before), np.cos(twists), np.sin(twists)))


def section_bases(w: Array, arm: Arm) -> tuple[Array, Array]:
    """Rotations (..., n_sections, 3, 3), twist included, and origins (..., n_sections, 3) [m] of the base frames.

    Args:
        w: (..., n_sections, 2) [rad].
        arm: the arm.
    """
    tips = section_tip_poses(w, arm)
    own = np.zeros_like(tips[..., :1, :3, 3])
    return section_base_rotations(tips, arm), np.concatenate([own, tips[..., :-1, :3, 3]], axis=-2)

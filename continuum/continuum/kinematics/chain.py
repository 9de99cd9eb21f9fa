"""Kinematics of the whole arm: a chain of sections, each rotated by its twist.

================================  ===================================================
arm_pose, section_tip_poses       Eq. 10, FK_cart
section_bases                     Eq. 10 up to the base of each section, twist included; section_base_rotations
next_tip, along_the_arm           Eq. 10, for one section and for all in order
arm_jacobian                      Eq. 11, J_x,zeta: Eq. 20 of every section, carried to the arm's tip
section_columns                   Eq. 11, the columns of one section
================================  ===================================================
"""

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
    cross,
    entries_of,
    matrix,
    product,
    rotated,
    transform,
    turned_about_z,
    vector,
)
from continuum.kinematics.section import position_entries, position_jacobian, rotation_entries, rotation_jacobian


def next_tip(base: Entries9, position: Entries3, u: Any, v: Any, b: float, n_joints: int) -> tuple[Entries9, Entries3]:
    """Eq. 10, one section: rotation and position [m] of its tip from its base, twist included; u, v [rad], b [m]."""
    step = rotated(base, position_entries(u, v, b, n_joints))
    tip = (position[0] + step[0], position[1] + step[1], position[2] + step[2])
    return product(base, rotation_entries(u, v)), tip


def along_the_arm(w: Array, arm: Arm) -> Iterator[tuple[Entries9, Entries9, Entries3]]:
    """Eq. 10, section by section: rotation of the base, twist included, rotation and position [m] of the tip."""
    rotation: Entries9 = IDENTITY
    position: Entries3 = (0.0, 0.0, 0.0)
    for i, section in enumerate(arm.sections):
        base = turned_about_z(rotation, np.cos(section.twist), np.sin(section.twist))
        rotation, position = next_tip(base, position, w[..., i, 0], w[..., i, 1], section.b, section.n_joints)
        yield base, rotation, position


def section_tip_poses(w: Array, arm: Arm) -> Array:
    """Eq. 10: poses (..., n_sections, 4, 4) [m] of the tips in ``base_link`` at ``w`` (..., n_sections, 2) [rad]."""
    poses = [transform(matrix(rotation), vector(position)) for _, rotation, position in along_the_arm(w, arm)]
    return np.stack(poses, axis=-3)


def arm_pose(w: Array, arm: Arm) -> Array:
    """Pose (..., 4, 4) [m] of the arm's tip in ``base_link`` at ``w`` (..., n_sections, 2) [rad]: Eq. 10, FK_cart."""
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


TipVelocity = tuple[Entries3, Entries3]
"""Linear [m/rad] and angular [rad/rad] velocity of the arm's tip per rate of one coordinate."""


def section_columns(
    base: Entries9, lever: Entries3, u: Any, v: Any, b: float, n_joints: int
) -> tuple[TipVelocity, TipVelocity]:
    """Eq. 11: velocity of the arm's tip per rate of a section's u, and per rate of its v, in ``base_link``.

    A section moves the arm's tip by the translation of the section's tip and by rotating all that follows it.

    Args:
        base: rotation of the section's base, twist included.
        lever: from the section's tip to the arm's tip [m].
        u: first coordinate of the section [rad].
        v: second coordinate of the section [rad].
        b: distance disc to joint of the section [m].
        n_joints: number of joints of the section.
    """
    linear_u, linear_v = position_jacobian(u, v, b, n_joints)
    angular_u, angular_v = rotation_jacobian(u, v)
    return _carried(base, lever, linear_u, angular_u), _carried(base, lever, linear_v, angular_v)


def _carried(base: Entries9, lever: Entries3, linear: Entries3, angular: Entries3) -> TipVelocity:
    turn = rotated(base, angular)
    own, swing = rotated(base, linear), cross(turn, lever)
    return (own[0] + swing[0], own[1] + swing[1], own[2] + swing[2]), turn


def arm_jacobian(w: Array, arm: Arm) -> Array:
    """Eq. 11: geometric Jacobian (..., 6, 2 n_sections) of the tip at ``w`` (..., n_sections, 2) [rad].

    Rows: linear velocity of the tip [m/rad], angular velocity [rad/rad], in ``base_link``; columns: u, v of section 1,
    of section 2, ...
    """
    along = list(along_the_arm(w, arm))
    tip = along[-1][2]
    columns = []
    for i, (section, (base, _, position)) in enumerate(zip(arm.sections, along, strict=True)):
        lever = (tip[0] - position[0], tip[1] - position[1], tip[2] - position[2])
        both = section_columns(base, lever, w[..., i, 0], w[..., i, 1], section.b, section.n_joints)
        columns += [np.concatenate([vector(linear), vector(angular)], axis=-1) for linear, angular in both]
    return np.stack(columns, axis=-1)

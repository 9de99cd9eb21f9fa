"""Thesis Eq. 11, chained over the sections: velocity of the arm's tip from the rates of all configurations."""

from __future__ import annotations

from typing import Any

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.chain.eq10_pose import along_the_arm
from continuum.kinematics.rigid import Entries3, Entries9, cross, rotated, vector
from continuum.kinematics.section.eq21_jacobian import position_jacobian, rotation_jacobian

TipVelocity = tuple[Entries3, Entries3]
"""Linear [m/rad] and angular [rad/rad] velocity of the arm's tip per rate of one coordinate."""


def section_columns(
    base: Entries9, lever: Entries3, u: Any, v: Any, b: float, n_joints: int
) -> tuple[TipVelocity, TipVelocity]:
    """Velocity of the arm's tip per rate of a section's u, and per rate of its v, in ``base_link``.

    A section moves the tip by its own tip's motion and by turning all that comes after it.

    Args:
        base: rotation of the section's base, twist included.
        lever: from the section's tip to the arm's tip [m].
        u: of the section [rad].
        v: of the section [rad].
        b: of the section [m].
        n_joints: of the section.
    """
    linear_u, linear_v = position_jacobian(u, v, b, n_joints)
    angular_u, angular_v = rotation_jacobian(u, v)
    return _carried(base, lever, linear_u, angular_u), _carried(base, lever, linear_v, angular_v)


def _carried(base: Entries9, lever: Entries3, linear: Entries3, angular: Entries3) -> TipVelocity:
    turn = rotated(base, angular)
    own, swing = rotated(base, linear), cross(turn, lever)
    return (own[0] + swing[0], own[1] + swing[1], own[2] + swing[2]), turn


def arm_jacobian(w: Array, arm: Arm) -> Array:
    """Geometric Jacobian (..., 6, 2 n_sections) of the arm's tip at ``w`` (..., n_sections, 2) [rad], in ``base_link``.

    Rows: linear velocity of the tip [m/rad], angular velocity [rad/rad]; columns: u, v of section 1, of section 2, ...
    """
    along = list(along_the_arm(w, arm))
    tip = along[-1][2]
    columns = []
    for i, (section, (base, _, position)) in enumerate(zip(arm.sections, along, strict=True)):
        lever = (tip[0] - position[0], tip[1] - position[1], tip[2] - position[2])
        both = section_columns(base, lever, w[..., i, 0], w[..., i, 1], section.b, section.n_joints)
        columns += [np.concatenate([vector(linear), vector(angular)], axis=-1) for linear, angular in both]
    return np.stack(columns, axis=-1)

"""Pose of the arm's tip and its Jacobian, compiled: Eqs. 10 and 11 in a loop over the sections."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.chain import next_tip, section_columns
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.equations import compiled, inlined
from continuum.kinematics.rigid import IDENTITY, Entries3, Entries9, turned_about_z


@inlined
def walk_to_tip(arm: ArmArrays, w: Array, bases: Array, tips: Array) -> tuple[Entries9, Entries3]:
    """Return the rotation and position [m] of the tip at ``w`` (2 n_sections,) [rad], in ``base_link``.

    Fills ``bases`` (n_sections + 1, 9) with the rotation entries of the sections' bases, twist included, and of the
    tip, and ``tips`` (n_sections, 3) with the positions of the sections' tips [m].
    """
    rotation, position = IDENTITY, (0.0, 0.0, 0.0)
    for i in range(len(arm.b)):
        base = turned_about_z(rotation, arm.cos_twist[i], arm.sin_twist[i])
        rotation, position = next_tip(base, position, w[2 * i], w[2 * i + 1], arm.b[i], arm.n_joints[i])
        for k in range(9):
            bases[i, k] = base[k]
        for k in range(3):
            tips[i, k] = position[k]
    for k in range(9):
        bases[-1, k] = rotation[k]
    return rotation, position


@inlined
def fill_jacobian(arm: ArmArrays, w: Array, bases: Array, tips: Array, jacobian: Array) -> None:
    """Fill ``jacobian`` (6, 2 n_sections) of the tip in ``base_link``: linear [m/rad], then angular [rad/rad].

    ``bases`` and ``tips`` are those that `walk_to_tip` fills at ``w`` (2 n_sections,) [rad].
    """
    n = len(tips)
    x, y, z = tips[n - 1, 0], tips[n - 1, 1], tips[n - 1, 2]
    for i in range(n):
        lever = (x - tips[i, 0], y - tips[i, 1], z - tips[i, 2])
        along_u, along_v = section_columns(nine(bases[i]), lever, w[2 * i], w[2 * i + 1], arm.b[i], arm.n_joints[i])
        for k in range(3):
            jacobian[k, 2 * i], jacobian[3 + k, 2 * i] = along_u[0][k], along_u[1][k]
            jacobian[k, 2 * i + 1], jacobian[3 + k, 2 * i + 1] = along_v[0][k], along_v[1][k]


@inlined
def nine(o: Array) -> Entries9:
    """Return the entries of a rotation from an array (9,)."""
    return (o[0], o[1], o[2], o[3], o[4], o[5], o[6], o[7], o[8])


@compiled
def tip_and_jacobian(arm: ArmArrays, w: Array, jacobian: Array) -> tuple[Entries9, Entries3]:
    """Return the rotation and position [m] of the tip at ``w`` (2 n_sections,) [rad], and fill ``jacobian``."""
    bases, tips = np.empty((len(arm.b) + 1, 9)), np.empty((len(arm.b), 3))
    rotation, position = walk_to_tip(arm, w, bases, tips)
    fill_jacobian(arm, w, bases, tips, jacobian)
    return rotation, position

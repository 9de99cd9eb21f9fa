"""Pose of the arm's tip and its Jacobian, compiled: Eqs. 10 and 11 in a loop over the sections."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.chain.eq10_pose import next_tip
from continuum.kinematics.chain.eq11_jacobian import section_columns
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.equations import compiled
from continuum.kinematics.rigid import IDENTITY, Entries3, Entries9, turned_about_z


@compiled
def tip_and_jacobian(arm: ArmArrays, w: Array, jacobian: Array) -> tuple[Entries9, Entries3]:
    """Rotation and position [m] of the tip at ``w`` (2 n_sections,) [rad].

    Fills ``jacobian`` (6, 2 n_sections): linear [m/rad], then angular [rad/rad], in ``base_link``.
    """
    n = len(arm.b)
    bases = np.empty((n, 9))
    tips = np.empty((n, 3))
    rotation, position = IDENTITY, (0.0, 0.0, 0.0)
    for i in range(n):
        base = turned_about_z(rotation, arm.cos_twist[i], arm.sin_twist[i])
        rotation, position = next_tip(base, position, w[2 * i], w[2 * i + 1], arm.b[i], arm.n_joints[i])
        for k in range(9):
            bases[i, k] = base[k]
        for k in range(3):
            tips[i, k] = position[k]
    for i in range(n):
        o = bases[i]
        base = (o[0], o[1], o[2], o[3], o[4], o[5], o[6], o[7], o[8])
        lever = (position[0] - tips[i, 0], position[1] - tips[i, 1], position[2] - tips[i, 2])
        along_u, along_v = section_columns(base, lever, w[2 * i], w[2 * i + 1], arm.b[i], arm.n_joints[i])
        for k in range(3):
            jacobian[k, 2 * i], jacobian[3 + k, 2 * i] = along_u[0][k], along_u[1][k]
            jacobian[k, 2 * i + 1], jacobian[3 + k, 2 * i + 1] = along_v[0][k], along_v[1][k]
    return rotation, position

"""Thesis Eq. 11, chained over the sections: velocity of the arm's tip from the rates of all configurations."""

from __future__ import annotations

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.chain.eq10_pose import section_base_rotations, section_tip_poses
from continuum.kinematics.section import section_jacobian


def arm_jacobian(w: Array, arm: Arm) -> Array:
    """Geometric Jacobian (..., 6, 2 n_sections) of the arm's tip at ``w`` (..., n_sections, 2) [rad], in ``base_link``.

    Rows: linear velocity of the tip [m/rad], angular velocity [rad/rad]; columns: u, v of section 1, of section 2, ...
    A section moves the tip by its own tip's motion and by turning all that comes after it.
    """
    poses = section_tip_poses(w, arm)
    bases = section_base_rotations(poses, arm)
    tip = poses[..., -1, :3, 3]
    columns = []
    for i, section in enumerate(arm.sections):
        local = section_jacobian(w[..., i, :], section)
        base = bases[..., i, :, :]
        angular = base @ local[..., 3:, :]
        lever = (tip - poses[..., i, :3, 3])[..., None]
        linear = base @ local[..., :3, :] + np.cross(angular, lever, axisa=-2, axisb=-2, axisc=-2)
        columns.append(np.concatenate([linear, angular], axis=-2))
    return np.concatenate(columns, axis=-1)

"""The whole arm: sections one after the other, each turned by its twist."""

from continuum.kinematics.chain.eq10_pose import arm_pose, section_base_rotations, section_bases, section_tip_poses
from continuum.kinematics.chain.eq11_jacobian import arm_jacobian

__all__ = ["arm_jacobian", "arm_pose", "section_base_rotations", "section_bases", "section_tip_poses"]

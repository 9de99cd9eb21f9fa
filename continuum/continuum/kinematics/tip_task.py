"""The task of an inverse kinematics step: error of the tip to its target, and how the configurations move the tip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.ik_result import Target


@dataclass(frozen=True)
class TipTask:
    """A target for one arm.

    The direction's error is weighted by a tenth of the arm's length, so that all rows are lengths.
    """

    arm: Arm
    target: Target

    @property
    def weight(self) -> float:
        """What one radian of direction counts [m]."""
        return 0.1 * self.arm.length

    def error(self, w: Array) -> Array:
        """Target minus tip at ``w`` (n_sections, 2) [rad]: (3,) [m], or (6,) [m] with the direction."""
        pose = arm_pose(w, self.arm)
        position = self.target.position - pose[:3, 3]
        if self.target.direction is None:
            return position
        return np.concatenate([position, self.weight * (self.target.direction - pose[:3, 2])])

    def jacobian(self, w: Array) -> Array:
        """d(position, weighted tip axis) / d w, (3 or 6, 2 n_sections) [m/rad], at ``w`` (n_sections, 2) [rad]."""
        geometric = arm_jacobian(w, self.arm)
        if self.target.direction is None:
            return geometric[:3]
        axis = arm_pose(w, self.arm)[:3, 2]
        axis_motion = np.cross(geometric[3:], axis, axisa=0, axisc=0)
        return np.concatenate([geometric[:3], self.weight * axis_motion])

    def distance_and_angle(self, w: Array) -> tuple[float, float]:
        """Distance [m] and angle [rad] from the tip to the target; the angle is 0 where the direction is free."""
        pose = arm_pose(w, self.arm)
        distance = float(np.linalg.norm(self.target.position - pose[:3, 3]))
        if self.target.direction is None:
            return distance, 0.0
        sine = np.linalg.norm(np.cross(pose[:3, 2], self.target.direction))
        return distance, float(np.arctan2(sine, pose[:3, 2] @ self.target.direction))

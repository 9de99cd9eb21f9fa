"""Configurations of the sections from angles of named joints, and vice versa."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.configuration import allen_from_jones, jones_from_allen


def joints_of(w: Array, arm: Arm) -> dict[str, float]:
    """Return the angles [rad] of the joints that others mimic, at ``w`` (n_sections, 2) [rad]."""
    joints: dict[str, float] = {}
    for section, (phi, theta) in zip(arm.sections, np.transpose(jones_from_allen(w)).tolist(), strict=True):
        joints[section.phi_joint] = phi
        joints[section.theta_joints[0]] = theta / section.n_joints
    return joints


def configuration_of_joints(joints: Mapping[str, float], arm: Arm) -> Array:
    """Return the configuration w, (n_sections, 2) [rad]; theta is n times the mean of the named joints of a section.

    A section without a named joint is straight.
    """
    w = np.zeros((arm.n_sections, 2))
    for i, section in enumerate(arm.sections):
        angles = [joints[name] for name in section.theta_joints if name in joints]
        if angles:
            w[i] = allen_from_jones(joints.get(section.phi_joint, 0.0), sum(angles) * section.n_joints / len(angles))
    return w

"""Joints of the whole arm, section by section from the base."""

from __future__ import annotations

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum_manipulator.section_joints import Configuration, joint_names, joint_values


def arm_joint_names(arm: Arm) -> tuple[str, ...]:
    """Return the names of all joints."""
    return tuple(name for section in arm.sections for name in joint_names(section))


def arm_joint_values(w: Array, w_rate: Array | None, arm: Arm) -> tuple[Array, Array | None]:
    """Return positions [rad] and rates [rad/s] of all joints at ``w`` (n_sections, 2) [rad] and ``w_rate`` [rad/s].

    The rates are None if ``w_rate`` is None.
    """
    values = [
        joint_values(Configuration(w[i], None if w_rate is None else w_rate[i]), section)
        for i, section in enumerate(arm.sections)
    ]
    positions = np.concatenate([position for position, _ in values])
    return positions, None if w_rate is None else np.concatenate([rate for _, rate in values])

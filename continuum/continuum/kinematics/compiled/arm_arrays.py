"""An arm as compiled code sees it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from continuum.arm import Arm
from continuum.arrays import Array


class ArmArrays(NamedTuple):
    """Geometry of the sections, each (n_sections,).

    Attributes:
        b: distance disc to joint [m].
        n_joints: number of joints.
        cos_twist: of the turn from the section before.
        sin_twist: of the same.
        bend_limit: largest bend [rad].
    """

    b: Array
    n_joints: NDArray[np.int64]
    cos_twist: Array
    sin_twist: Array
    bend_limit: Array


def arm_arrays(arm: Arm, with_limits: bool = True) -> ArmArrays:
    """The arrays of ``arm``; without its limits, sections may bend until the holes of neighbouring discs meet."""
    twist = np.array([section.twist for section in arm.sections])
    limits = [section.bend_limit if with_limits else 0.999 * section.contact_bend for section in arm.sections]
    return ArmArrays(
        np.array([section.b for section in arm.sections]),
        np.array([section.n_joints for section in arm.sections], dtype=np.int64),
        np.cos(twist),
        np.sin(twist),
        np.array(limits),
    )

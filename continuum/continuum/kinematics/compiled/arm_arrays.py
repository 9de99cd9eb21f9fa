"""Representation of an arm in compiled code."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from continuum.arm import Arm
from continuum.arrays import Array

BEND_LIMIT, CONTACT = 4, 5
"""Rows of an arm's table with bends [rad]: the sections' bend limits, and the bends where disc holes nearly meet."""


class ArmArrays(NamedTuple):
    """Geometry of the sections, each (n_sections,).

    Attributes:
        b: distance disc to joint [m].
        n_joints: number of joints.
        cos_twist: cosine of the twist against the previous section.
        sin_twist: sine of the same twist.
        bend_limit: largest bend [rad].
    """

    b: Array
    n_joints: NDArray[np.int64]
    cos_twist: Array
    sin_twist: Array
    bend_limit: Array


def arm_table(arm: Arm) -> Array:
    """Return the arm as one array (6, n_sections), which is faster to pass in a call than several arrays.

    Rows are the attributes of :class:`ArmArrays`, with both kinds of limits.
    """
    sections = arm.sections
    twist = np.array([section.twist for section in sections])
    return np.array(
        [
            [section.b for section in sections],
            [section.n_joints for section in sections],
            np.cos(twist),
            np.sin(twist),
            [section.bend_limit for section in sections],
            [0.999 * section.contact_bend for section in sections],
        ]
    )


@register_jitable
def arrays_of(table: Array, limits: Array) -> ArmArrays:
    """Return the arrays of an arm's table, with ``limits`` from its row BEND_LIMIT or CONTACT."""
    return ArmArrays(table[0], table[1].astype(np.int64), table[2], table[3], limits)


def arm_arrays(arm: Arm, with_limits: bool = True) -> ArmArrays:
    """Return the arrays of ``arm``; without limits, sections may bend until the holes of neighbouring discs meet."""
    table = arm_table(arm)
    return arrays_of(table, table[BEND_LIMIT if with_limits else CONTACT])

"""An arm as compiled code sees it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from continuum.arm import Arm
from continuum.arrays import Array

BEND_LIMIT, CONTACT = 4, 5
"""Rows of an arm's table that hold bends [rad]: the sections' limits, and where their discs' holes nearly meet."""


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


def arm_table(arm: Arm) -> Array:
    """The arm in one array (6, n_sections), which a call hands over sooner than many.

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
    """The arrays of an arm's table, with the ``limits`` of one of its rows: BEND_LIMIT or CONTACT."""
    return ArmArrays(table[0], table[1].astype(np.int64), table[2], table[3], limits)


def arm_arrays(arm: Arm, with_limits: bool = True) -> ArmArrays:
    """The arrays of ``arm``; without its limits, sections may bend until the holes of neighbouring discs meet."""
    table = arm_table(arm)
    return arrays_of(table, table[BEND_LIMIT if with_limits else CONTACT])

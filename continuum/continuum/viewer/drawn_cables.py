"""Lengths of the drawn cables over a recording, for recordings that contain no cable lengths."""

from __future__ import annotations

import numpy as np

from continuum.arm import Arm
from continuum.viewer.cable_holes import CableHoles
from continuum.viewer.description import arm_description
from continuum.viewer.link_poses import LinkPoses
from continuum.viewer.tracks import Track

_MOST = 5000
"""Largest number of instants that are computed; with ten joints, this takes half a second."""

_AT_ONCE = 500
"""Number of instants that are computed together; all poses of a long recording would fill the memory."""


def drawn_cables(joints: Track, arm: Arm) -> Track:
    """Return the lengths [m] of all cables of an arm with the joint angles ``joints`` [rad]."""
    chain = LinkPoses(arm_description(arm))
    rows = np.unique(np.linspace(0, joints.times.size - 1, _MOST).astype(int))
    angles = np.array([chain.angles(dict(zip(joints.names, row, strict=True))) for row in joints.values[rows]])
    lengths = np.zeros((rows.size, len(arm.cable_names)))
    for passing in (False, True):
        holes = CableHoles(arm, chain.links, passing)
        columns = [arm.cable_names.index(name) for name in holes.cables.tolist()]
        for start in range(0, rows.size, _AT_ONCE):
            some = slice(start, start + _AT_ONCE)
            if columns:
                ends = holes.pieces(chain.poses(angles[some]))
                pieces = np.linalg.norm(ends[..., 1, :] - ends[..., 0, :], axis=-1)
                for column, piece in zip(columns, pieces.T, strict=True):
                    lengths[some, column] += piece
    return Track(joints.times[rows], tuple(arm.cable_names), lengths)

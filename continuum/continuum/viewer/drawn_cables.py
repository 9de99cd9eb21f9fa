"""Lengths of the drawn cables over a recording, for recordings that contain no cable lengths."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.viewer.cable_holes import CableHoles
from continuum.viewer.description import arm_description
from continuum.viewer.link_poses import LinkPoses
from continuum.viewer.tracks import Track

_MOST = 5000
"""Largest number of instants of the lengths on the page; with ten joints, they take half a second."""

_AT_ONCE = 500
"""Number of instants that are computed together; all poses of a long recording would fill the memory."""


class CableLengths:
    """Lengths of all cables of an arm from the poses of its links.

    Args:
        arm: arm.
        links: names of the links of its description.
    """

    def __init__(self, arm: Arm, links: Sequence[str]) -> None:
        self._n_cables = len(arm.cable_names)
        self._parts = []
        for holes in (CableHoles(arm, links, passing) for passing in (False, True)):
            if holes.cables.size:
                self._parts.append((holes, [arm.cable_names.index(name) for name in holes.cables.tolist()]))

    def at(self, poses: Array) -> Array:
        """Return the lengths, (n, n_cables) [m], at link ``poses``, (n, n_links, 4, 4) [m]."""
        lengths = np.zeros((self._n_cables, len(poses)))
        for holes, columns in self._parts:
            ends = holes.pieces(poses)
            np.add.at(lengths, columns, np.linalg.norm(ends[..., 1, :] - ends[..., 0, :], axis=-1).T)
        return lengths.T


def drawn_cables(joints: Track, arm: Arm) -> Track:
    """Return the lengths [m] of all cables at the joint angles ``joints`` [rad], at `_MOST` of the instants at most."""
    chain = LinkPoses(arm_description(arm))
    rows = np.unique(np.linspace(0, joints.times.size - 1, _MOST).astype(int))
    some = Track(joints.times[rows], joints.names, joints.values[rows])
    cables = CableLengths(arm, chain.links)
    lengths = np.concatenate([cables.at(poses) for poses in batches(chain, some)])
    return Track(some.times, tuple(arm.cable_names), lengths)


def batches(chain: LinkPoses, joints: Track) -> Iterator[Array]:
    """Yield the poses of all links at successive joint states, (n, n_links, 4, 4) [m] each."""
    for start in range(0, joints.times.size, _AT_ONCE):
        yield chain.poses(chain.angles_over(joints.names, joints.values[start : start + _AT_ONCE]))

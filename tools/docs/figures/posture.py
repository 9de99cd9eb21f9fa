"""Points of an arm's backbone and discs in one posture, in ``base_link``."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.cables import hole_points
from continuum.kinematics.chain import section_bases

_RIM = np.linspace(0.0, 2.0 * np.pi, 33)
_WIDER = 1.2  # ratio of the radius of a disc's rim to that of its holes


def backbone(w: Array, arm: Arm) -> Array:
    """Centres of all discs (n, 3) [m], from the base on, at ``w`` (n_sections, 2) [rad]."""
    return np.concatenate(list(_rings(w, arm, 0.0))).mean(axis=1)


def discs(w: Array, arm: Arm) -> Array:
    """Rims of all discs (n, n_rim, 3) [m], from the base on, at ``w`` (n_sections, 2) [rad]."""
    return np.concatenate(list(_rings(w, arm, _WIDER)))


def _rings(w: Array, arm: Arm, wide: float) -> Iterator[Array]:
    """Yield for each section circles (n_joints + 1, n_rim, 3) [m] on its discs, ``wide`` times as wide as its holes."""
    for section, bent, rotation, origin in zip(arm.sections, w, *section_bases(w, arm), strict=True):
        holes = hole_points(bent, section, np.full(_RIM.size, wide * section.a), _RIM)
        yield np.swapaxes(holes, 0, 1) @ rotation.T + origin

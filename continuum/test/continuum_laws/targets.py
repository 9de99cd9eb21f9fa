"""Targets for the solvers of inverse kinematics: reachable ones by forward kinematics, and hard ones."""

import numpy as np

from continuum.arm import Arm
from continuum.kinematics.chain import arm_pose
from continuum_laws.samples import random_postures

HARD_POSITIONS = (
    (0.0, 0.0, 0.0),
    (0.0, 0.0, -0.2),
    (0.0, 0.0, 1e6),
    (1e-300, 0.0, 0.1),
    (1e3, -1e3, 0.0),
    (0.0, 1e-3, 0.0),
    (0.05, 0.0, -0.4),
)
HARD_DIRECTIONS = (None, (0.0, 0.0, -1.0), (0.0, 0.0, 1e9), (1e-6, 0.0, 0.0), (-1.0, 1.0, 0.0))

MALFORMED_VECTORS = (
    (0.1, 0.2),
    (0.1, 0.2, 0.3, 0.4),
    (np.nan, 0, 0.1),
    (0, np.inf, 0.1),
    "abc",
    None,
    1.0,
    ([1], 2, 3),
)


def reachable_targets(arm: Arm, n: int, seed: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Positions (3,) [m] and directions (3,) of the tip at random postures within the bend limits."""
    poses = arm_pose(random_postures(arm, n, seed), arm)
    return [(pose[:3, 3], pose[:3, 2]) for pose in poses]

"""Targets for the solvers of inverse kinematics: reachable ones by forward kinematics, and hard ones."""

import numpy as np

from continuum.arm import Arm
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.ik_target import DIRECTION, POSE, Targets
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


def targets_at(arm: Arm, postures: np.ndarray, kind: int) -> Targets:
    """The tips at ``postures`` (n, n_sections, 2) [rad] as targets: POSITION, DIRECTION or POSE."""
    poses = arm_pose(postures, arm)
    return Targets(
        poses[:, :3, 3],
        poses[:, :3, 2] if kind == DIRECTION else None,
        poses[:, :3, :3] if kind == POSE else None,
    )


def misses(arm: Arm, configurations: np.ndarray, targets: Targets) -> tuple[np.ndarray, np.ndarray]:
    """Distances [m] and angles [rad], each (n,), by which the tips at ``configurations`` miss their targets."""
    poses = arm_pose(configurations, arm)
    distances = np.linalg.norm(poses[:, :3, 3] - targets.positions, axis=-1)
    if targets.directions is not None:
        z, wanted = poses[:, :3, 2], targets.directions
        return distances, np.arctan2(np.linalg.norm(np.cross(z, wanted), axis=-1), np.sum(z * wanted, axis=-1))
    if targets.rotations is not None:
        turn = np.swapaxes(poses[:, :3, :3], -1, -2) @ targets.rotations
        sine = np.linalg.norm(turn - np.swapaxes(turn, -1, -2), axis=(-2, -1)) / np.sqrt(8.0)
        return distances, np.arctan2(sine, 0.5 * (np.trace(turn, axis1=-2, axis2=-1) - 1.0))
    return distances, np.zeros(len(distances))

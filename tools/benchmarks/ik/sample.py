"""Reachable targets, computed from random postures."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from continuum.arm import Arm, Section
from continuum.arrays import Array
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import bend
from continuum.kinematics.ik_target import Target, Targets


@dataclass(frozen=True)
class Sample:
    """Reachable targets from postures of the arm: positions and directions of the tip."""

    arm: Arm
    targets: Targets
    starts: Array


def prototype_arm(n_sections: int) -> Arm:
    """Return an arm of sections with five of the prototype's modules (Table 1), each twisted by 30 degrees."""
    return Arm(
        tuple(Section(f"s{i}", 5, 0.01925, 0.032, twist=math.radians(30) if i else 0.0) for i in range(n_sections))
    )


def draw(arm: Arm, largest_bend: float, n: int, rng: np.random.Generator) -> Sample:
    """Draw ``n`` postures with bends up to ``largest_bend`` [rad], and as many random starts."""

    def postures(limit: float) -> Array:
        bend = rng.uniform(0.0, limit, (n, arm.n_sections))
        azimuth = rng.uniform(0.0, 2.0 * math.pi, (n, arm.n_sections))
        return np.stack([-bend * np.sin(azimuth), bend * np.cos(azimuth)], axis=-1)

    poses = arm_pose(postures(largest_bend), arm)
    return Sample(arm, Targets(poses[:, :3, 3], poses[:, :3, 2]), postures(math.pi))


def each_target(sample: Sample, n: int) -> Iterator[tuple[int, Target]]:
    for k in range(n):
        yield k, Target(sample.targets.positions[k], sample.targets.directions[k])


def arrived(sample: Sample, k: int, w: Array, tolerance: float) -> bool:
    """Return whether a solution is right by the library's forward kinematics, with a margin of 1 % for rounding.

    A section bent beyond its limit is not a solution.
    """
    pose = arm_pose(w, sample.arm)
    if np.any(bend(w) > [section.bend_limit + 1e-9 for section in sample.arm.sections]):
        return False
    distance = np.linalg.norm(pose[:3, 3] - sample.targets.positions[k])
    angle = np.linalg.norm(np.cross(pose[:3, 2], sample.targets.directions[k]))
    return bool(
        distance <= 1.01 * tolerance and angle <= 1.01 * tolerance and pose[:3, 2] @ sample.targets.directions[k] > 0
    )

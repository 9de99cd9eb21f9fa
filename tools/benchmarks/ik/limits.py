"""`python3 -m tools.benchmarks.ik.limits`: statuses of the answers to targets at and beyond bend limits."""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from itertools import product

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import allen_from_jones, bend
from continuum.kinematics.ik_result import IkStatus
from continuum.kinematics.ik_target import DIRECTION, POSE, POSITION, Targets
from continuum.kinematics.inverse_kinematics import InverseKinematics
from tools.benchmarks.ik.sample import prototype_arm
from tools.benchmarks.record import Record, Table
from tools.benchmarks.report import as_text, publish
from tools.one_line import in_one_line

N = 5000
KINDS = {POSITION: "position", DIRECTION: "direction", POSE: "full pose"}
ASKED = ((1, DIRECTION), (2, POSITION), (2, DIRECTION), (3, DIRECTION), (3, POSE), (4, POSE))
BENT = (
    (0.0, 5.3, 5.3),
    (3.2, 5.3, math.pi),
    (math.pi, math.pi, math.pi),
    (1.5, 1.5, 1.5),
    (0.5, 0.5, 0.5),
)
"""Smallest and largest bend of a section of the targets, and its limit [rad]."""


def main() -> None:
    rows = [
        (n_sections, KINDS[kind], f"{least:.3g} to {most:.3g}", f"{limit:.3g}",
         *_statuses(_limited(prototype_arm(n_sections), limit), kind, least, most))
        for (n_sections, kind), (least, most, limit) in product(ASKED, BENT)
    ]  # fmt: skip
    head = ("sections", "target", "bends [rad]", "limit [rad]", *(status.name for status in IkStatus), "beyond")
    note = f"{N} targets a row, of evenly drawn bends; the last column counts answers that are bent beyond the limits."
    command = "python3 -m tools.benchmarks.ik.limits"
    record = Record("ik-limits", command, (), {"statuses": Table.of(head, rows)}, (note,))
    print(as_text(record))
    publish(record)


def _limited(arm: Arm, limit: float) -> Arm:
    return Arm(tuple(replace(section, bend_limit=limit) for section in arm.sections))


def _statuses(arm: Arm, kind: int, least: float, most: float) -> tuple[int, ...]:
    rng = np.random.default_rng([2018, arm.n_sections, kind])
    theta = rng.uniform(least, most, (N, arm.n_sections))
    poses: Array = arm_pose(allen_from_jones(rng.uniform(0.0, 2.0 * math.pi, theta.shape), theta), arm)
    directions = poses[:, :3, 2] if kind == DIRECTION else None
    rotations = poses[:, :3, :3] if kind == POSE else None
    batch = InverseKinematics(arm).solve_many(Targets(poses[:, :3, 3], directions, rotations))
    beyond = np.sum(bend(batch.configurations) > np.array([s.bend_limit for s in arm.sections]) + 1e-9)
    return *np.bincount(batch.statuses, minlength=len(IkStatus)).tolist(), int(beyond)


if __name__ == "__main__":
    sys.exit(in_one_line(main))

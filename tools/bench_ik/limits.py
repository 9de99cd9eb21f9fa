"""`python3 -m tools.bench_ik.limits`: how targets beyond and at bend limits are answered, by counts of the statuses."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import allen_from_jones, bend
from continuum.kinematics.ik_result import IkStatus
from continuum.kinematics.ik_target import DIRECTION, POSE, POSITION, Targets
from continuum.kinematics.inverse_kinematics import InverseKinematics
from tools.bench_ik.sample import prototype_arm

N = 5000
KINDS = {POSITION: "position", DIRECTION: "direction", POSE: "full pose"}
ASKED = ((1, DIRECTION), (2, POSITION), (2, DIRECTION), (3, DIRECTION), (3, POSE), (4, POSE))


def main() -> None:
    head = " | ".join(status.name for status in IkStatus)
    print(f"{N} targets a row, made by bends drawn evenly\n| sections | target | bends [rad] | limit [rad] | {head} |")
    print("|---|---|---|---|---|---|---|---|")
    for n_sections, kind in ASKED:
        for least, most, limit in (
            (0.0, 5.3, 5.3),
            (3.2, 5.3, math.pi),
            (math.pi, math.pi, math.pi),
            (1.5, 1.5, 1.5),
            (0.5, 0.5, 0.5),
        ):
            counts = _statuses(_limited(prototype_arm(n_sections), limit), kind, least, most)
            print(f"| {n_sections} | {KINDS[kind]} | {least:.3g} to {most:.3g} | {limit:.3g} | {counts} |", flush=True)


def _limited(arm: Arm, limit: float) -> Arm:
    return Arm(tuple(replace(section, bend_limit=limit) for section in arm.sections))


def _statuses(arm: Arm, kind: int, least: float, most: float) -> str:
    rng = np.random.default_rng([2018, arm.n_sections, kind])
    theta = rng.uniform(least, most, (N, arm.n_sections))
    poses: Array = arm_pose(allen_from_jones(rng.uniform(0.0, 2.0 * math.pi, theta.shape), theta), arm)
    directions = poses[:, :3, 2] if kind == DIRECTION else None
    rotations = poses[:, :3, :3] if kind == POSE else None
    batch = InverseKinematics(arm).solve_many(Targets(poses[:, :3, 3], directions, rotations))
    beyond = np.sum(bend(batch.configurations) > np.array([s.bend_limit for s in arm.sections]) + 1e-9)
    output = " | ".join(str(count) for count in np.bincount(batch.statuses, minlength=len(IkStatus)))
    return output + (f" ({beyond} bends beyond the limits)" if beyond else "")


if __name__ == "__main__":
    main()

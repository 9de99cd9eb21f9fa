"""Inverse kinematics for a single target: FABRIKc for the start, Gauss-Newton to the end, then other starts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.fabrikc import solve_fabrikc
from continuum.kinematics.gauss_newton import refine
from continuum.kinematics.ik_result import IkResult, Target, configuration_of
from continuum.kinematics.nearest_pose import nearest_pose
from continuum.kinematics.tip_task import TipTask

_FABRIKC_ITERATIONS = 10
_N_RESTARTS = 8


def solve(
    arm: Arm,
    position: Array,
    direction: Array | None = None,
    start: Array | None = None,
    tolerance: float = 1e-6,
) -> IkResult:
    """Configuration that brings the tip to ``position`` (3,) [m], its z axis along ``direction`` (3,) if given.

    The starts are tried in turn until one solves the target: ``start`` by itself, FABRIKc from there, FABRIKc from the
    straight arm and from postures bent to other sides. If all fail, the distance is minimised from the best of them:
    the answer is then the nearest pose that was found, with its distance.

    Raises:
        InvalidValueError: malformed target or start.
    """
    target = Target(position, direction)
    weight = TipTask(arm, target).weight
    best: IkResult | None = None
    iterations = 0
    for begin in _starts(arm, target, start):
        result = refine(arm, target, begin, tolerance)
        iterations += result.iterations
        if best is None or result.distance + weight * result.angle < best.distance + weight * best.angle:
            best = result
        if result.solved:
            return replace(result, iterations=iterations)
    nearest = nearest_pose(arm, target, best.configuration if best else None, tolerance)
    return replace(nearest, iterations=iterations + nearest.iterations)


def _starts(arm: Arm, target: Target, start: Array | None) -> Iterator[Array]:
    first = configuration_of(arm, start)
    if start is not None:
        yield first
    yield _from_fabrikc(arm, target, first)
    if start is not None:
        yield _from_fabrikc(arm, target, np.zeros_like(first))
    for k in range(_N_RESTARTS):
        # Sections bent by a right angle, each start and each section to another side.
        azimuths = 2.0 * np.pi * (k / _N_RESTARTS + (k + 1) * np.arange(arm.n_sections) / (arm.n_sections + 1))
        posture = 0.5 * np.pi * np.stack([-np.sin(azimuths), np.cos(azimuths)], axis=-1)
        yield _from_fabrikc(arm, target, posture)


def _from_fabrikc(arm: Arm, target: Target, start: Array) -> Array:
    return solve_fabrikc(
        arm, target.position, target.direction, start, max_iterations=_FABRIKC_ITERATIONS
    ).configuration

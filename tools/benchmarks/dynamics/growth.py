"""Cost of a simulated second and of compiling the equations as functions of the number of joints."""

from __future__ import annotations

import os
import tempfile
import time
from dataclasses import dataclass

import numpy as np

from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus
from tools.benchmarks.dynamics.scene import cpu_time, longer_arm

SECONDS = 0.4  # simulated


@dataclass(frozen=True)
class Size:
    """One arm.

    Attributes:
        n_joints: number of joints.
        compiling: elapsed time of compiling its equations once [s].
        per_second: processor time of a simulated second [s].
        steps: number of steps in a simulated second.
    """

    n_joints: int
    compiling: float
    per_second: float
    steps: float


def measure(n_joints: int, repeats: int) -> Size:
    """Release an arm of ``n_joints`` after a new compilation."""
    scene = longer_arm(n_joints, SECONDS)
    kept = os.environ.get("XDG_CACHE_HOME")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["XDG_CACHE_HOME"] = folder
        try:
            began = time.perf_counter()
            simulator = Simulator(scene.model)
            _ = simulator.equations.residual, simulator.equations.stage
            compiling = time.perf_counter() - began
        finally:
            del os.environ["XDG_CACHE_HOME"]
            if kept is not None:
                os.environ["XDG_CACHE_HOME"] = kept
    simulator.run(scene.start, scene.times[:2])
    seconds, found = cpu_time(lambda: simulator.run(scene.start, scene.times), repeats)
    if found.status is not SimulationStatus.COMPLETE:
        raise RuntimeError(f"{n_joints} joints: {found.status.value}")
    return Size(n_joints, compiling, seconds / SECONDS, found.steps / SECONDS)


def exponent(sizes: list[Size]) -> float:
    """Slope of log time over log joints, least squares."""
    joints, seconds = (np.log([getattr(size, name) for size in sizes]) for name in ("n_joints", "per_second"))
    return float(np.polyfit(joints, seconds, 1)[0])

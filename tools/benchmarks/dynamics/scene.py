"""The simulated motions of the benchmark, and the timing of simulations."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.integration.esdirk_tableau import fourth_order
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.parameters import PARAMETERS, Parameters
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus
from continuum.dynamics.values import shared_directions

RATE = 120.0  # outputs a second
TABLE_3 = ("stiffness", "viscous_friction", "coulomb_friction", "stribeck_gain", "stribeck_speed")
OTHERS = ("mass", "inertia", "center_of_mass", "half_spacing", "gravity")


@dataclass(frozen=True)
class Scene:
    """A release.

    Attributes:
        model: model of the arm.
        start: joint angles at rest, (n,) [rad].
        times: output times, (n_times,) [s].
    """

    model: Model
    start: Array
    times: Array

    @property
    def directions(self) -> Array:
        """Directions of ten parameters, each equal in all joints, (n_p, 10)."""
        return shared_directions(self.model, TABLE_3 + OTHERS)

    def converged(self) -> Array:
        """Joint angles at tolerances ten thousand times tighter, (n_times, n) [rad]."""
        tight = Simulator(self.model, Tolerances(1e-8, 1e-9, 0.01), fourth_order())
        found = tight.run(self.start, self.times)
        if found.status is not SimulationStatus.COMPLETE:
            raise RuntimeError(f"no converged solution: {found.status.value}")
        return found.theta


def prototype_release(seconds: float = 1.6) -> Scene:
    """The prototype from 15 degrees at every joint, slack cables."""
    model = load_model("lamecc_prototype.yaml")
    return Scene(model, np.full(model.n_joints, np.radians(15.0)), output_times(seconds))


def longer_arm(n_joints: int, seconds: float) -> Scene:
    """Return an arm of the prototype's links, bent evenly by 75 degrees in total."""
    values = load_model("lamecc_prototype.yaml").parameters.named()
    alike = {name: PARAMETERS[name].array(float(value[0]), n_joints, name) for name, value in values.items()}
    return Scene(Model(Parameters(**alike)), np.full(n_joints, np.radians(75.0) / n_joints), output_times(seconds))


def output_times(seconds: float) -> Array:
    return np.arange(round(seconds * RATE) + 1) / RATE


def cpu_time[T](run: Callable[[], T], repeats: int) -> tuple[float, T]:
    """Return the shortest processor time of several runs after an uncounted first one [s], and the last result."""
    answer, shortest = run(), np.inf
    for _ in range(repeats):
        began = time.process_time()
        answer = run()
        shortest = min(shortest, time.process_time() - began)
    return float(shortest), answer

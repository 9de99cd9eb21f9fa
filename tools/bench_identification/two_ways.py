"""Five parameters identified from the same runs, by slopes and by the thesis's swarm."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.discovery.trial import TOLERANCES
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.values import parameter_slots
from continuum.identification.baseline import with_dry_friction
from continuum.identification.fit import THESIS_PARAMETERS, fit
from continuum.identification.free import Free, FreeSpace
from continuum.identification.noise import estimate_noise
from continuum.identification.swarm import swarm_identification
from tools.bench_identification.arms import MeasuredArm

FREE = tuple(Free(name) for name in THESIS_PARAMETERS)


@dataclass(frozen=True)
class Answer:
    """What one way found.

    Attributes:
        values: by name.
        simulations: how many runs were simulated, those with slopes counted as one.
        seconds: of the wall's clock, equations compiled.
    """

    values: Mapping[str, float]
    simulations: int
    seconds: float

    def errors(self, truth: Mapping[str, float]) -> dict[str, float]:
        """Relative, by name."""
        return {name: value / truth[name] - 1 for name, value in self.values.items()}


def by_slopes(arm: MeasuredArm) -> Answer:
    """The library's fit, as `continuum diagnose` uses it."""
    simulator = Simulator(with_dry_friction(load_model("lamecc_prototype.yaml")), TOLERANCES)
    simulator.run(np.zeros(simulator.model.n_joints), np.array([0.0, 0.01]))
    began = time.perf_counter()
    fitted = fit(simulator, arm.runs, estimate_noise(arm.runs, None), FREE)
    seconds = time.perf_counter() - began
    return Answer({free.name: fitted.value(free) for free in FREE}, fitted.simulations, seconds)


def by_swarm(arm: MeasuredArm, seed: int) -> Answer:
    """Table 2 of the thesis."""
    simulator = Simulator(with_dry_friction(load_model("lamecc_prototype.yaml")), TOLERANCES)
    simulator.run(np.zeros(simulator.model.n_joints), np.array([0.0, 0.01]))
    space = FreeSpace(simulator.model, FREE)
    began = time.perf_counter()
    found = swarm_identification(simulator, arm.runs, space, np.random.default_rng(seed))
    seconds = time.perf_counter() - began
    return Answer(_named(simulator, space, found.coordinates), found.simulations, seconds)


def _named(simulator: Simulator, space: FreeSpace, coordinates: Array) -> dict[str, float]:
    values, slots = space.common_values(coordinates), parameter_slots(simulator.model)
    return {free.name: float(values[slots[free.name]][0]) for free in FREE}

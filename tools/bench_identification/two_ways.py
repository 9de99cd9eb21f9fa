"""Five parameters identified from the same runs, by smoothing and by the thesis's swarm."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.discovery.baseline import fitted_baseline, problem_of
from continuum.discovery.output_error import OutputError
from continuum.discovery.problem import linearise, point_of
from continuum.discovery.search import Found
from continuum.dynamics.dry_friction import with_dry_friction
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.values import parameter_slots
from continuum.estimation.structure import Structure
from continuum.identification.free import THESIS_PARAMETERS, Free, FreeSpace
from continuum.identification.swarm import swarm_identification
from tools.bench_identification.arms import MeasuredArm

FREE = tuple(Free(name) for name in THESIS_PARAMETERS)
_TOLERANCES = Tolerances(1e-3, 1e-4, 0.01)  # errors stay below a hundredth of a degree


@dataclass(frozen=True)
class Answer:
    """What one way found.

    Attributes:
        values: by name.
        simulations: how many runs were simulated.
        seconds: of the wall's clock, equations compiled.
    """

    values: Mapping[str, float]
    simulations: int
    seconds: float

    def errors(self, truth: Mapping[str, float]) -> dict[str, float]:
        """Relative, by name."""
        return {name: value / truth[name] - 1 for name, value in self.values.items()}


def by_smoothing(arm: MeasuredArm) -> Answer:
    """The library's estimate, as `continuum diagnose` tells it of the refitted model; means over the joints.

    Smoothing along linearised equations first, then a fit by open-loop simulations.
    """
    structure = Structure(with_dry_friction(load_model("lamecc_prototype.yaml")), with_tension=False)
    structure.compile()
    began = time.perf_counter()
    problem = problem_of(structure, arm.runs)
    state = fitted_baseline(problem)
    found = Found(linearise(problem, state, live=()), ())
    state = OutputError(problem, arm.runs).fit(found, []).state
    seconds = time.perf_counter() - began
    values = point_of(problem, state).values
    return Answer({name: float(np.mean(values[structure.slots[name]])) for name in THESIS_PARAMETERS}, 0, seconds)


def by_swarm(arm: MeasuredArm, seed: int) -> Answer:
    """Table 2 of the thesis."""
    simulator = Simulator(with_dry_friction(load_model("lamecc_prototype.yaml")), _TOLERANCES)
    simulator.run(np.zeros(simulator.model.n_joints), np.array([0.0, 0.01]))
    space = FreeSpace(simulator.model, FREE)
    began = time.perf_counter()
    found = swarm_identification(simulator, arm.runs, space, np.random.default_rng(seed))
    seconds = time.perf_counter() - began
    return Answer(_named(simulator, space, found.coordinates), found.simulations, seconds)


def _named(simulator: Simulator, space: FreeSpace, coordinates: Array) -> dict[str, float]:
    values, slots = space.common_values(coordinates), parameter_slots(simulator.model)
    return {free.name: float(values[slots[free.name]][0]) for free in FREE}

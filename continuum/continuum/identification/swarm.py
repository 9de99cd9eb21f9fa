"""The method of the thesis: a particle swarm (Gomes 2016, Table 2) that minimises Eq. 19 of the joint rates.

It is kept as the reference for fits by derivatives. Every run starts at rest from its first measured angles.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import Reading, SimulationStatus
from continuum.identification.free import FreeSpace
from continuum.identification.nrmse import rate_nrmse
from continuum.recordings.recording import Recording


@dataclass(frozen=True)
class SwarmSettings:
    """Table 2 of the thesis.

    Attributes:
        particles, iterations: numbers of particles and of iterations.
        objective_tolerance: least gain of the best particle that counts as progress.
        variation_tolerance: coefficient of variation of the particles below which the swarm has converged.
        cognitive, social: pull towards the particle's best place and the swarm's best place.
        momentum: fraction of the speed that is kept.
        constriction: factor against divergence.
    """

    particles: int = 20
    iterations: int = 40
    objective_tolerance: float = 0.001
    variation_tolerance: float = 0.0001
    cognitive: float = 3.0
    social: float = 2.0
    momentum: float = 0.1
    constriction: float = 0.1146


@dataclass(frozen=True)
class SwarmResult:
    """The best place found.

    Attributes:
        coordinates: coordinates of the unknowns, (k,).
        objective: Eq. 19 there, mean over the runs.
        simulations: number of simulated runs.
    """

    coordinates: Array
    objective: float
    simulations: int


def swarm_identification(
    simulator: Simulator,
    recordings: Sequence[Recording],
    space: FreeSpace,
    random: np.random.Generator,
    settings: SwarmSettings | None = None,
    progress: Callable[[float], None] | None = None,
) -> SwarmResult:
    """Identify the unknowns of ``space`` within a factor of three of their origin, and within their bounds.

    ``progress`` is called with the fraction of iterations that is done.
    """
    settings = settings or SwarmSettings()
    simulations = 0

    def objective(coordinates: Array) -> float:
        nonlocal simulations
        simulations += len(recordings)
        return float(np.mean([_run_objective(simulator, run, space.common_values(coordinates)) for run in recordings]))

    place, best = particle_swarm(
        objective, np.maximum(space.lower, -0.95), np.minimum(space.upper, 2.0), random, settings, progress
    )
    return SwarmResult(place, best, simulations)


def particle_swarm(
    objective: Callable[[Array], float],
    lower: Array,
    upper: Array,
    random: np.random.Generator,
    settings: SwarmSettings,
    progress: Callable[[float], None] | None = None,
) -> tuple[Array, float]:
    """Return the lowest place (k,) found within bounds, and the objective there.

    Speeds are v = chi (w v + l1 r1 (particle's best - x) + l2 r2 (swarm's best - x)) with new random r1, r2 each time.
    """
    place = random.uniform(lower, upper, (settings.particles, lower.size))
    speed = np.zeros_like(place)
    personal_place, personal_best = place.copy(), np.array([objective(x) for x in place])
    before = np.inf
    for iteration in range(settings.iterations):
        if progress is not None:
            progress(iteration / settings.iterations)
        global_best = int(np.argmin(personal_best))
        variation = np.std(place, axis=0) / np.maximum(np.abs(np.mean(place, axis=0)), 1e-12)
        if before - personal_best[global_best] < settings.objective_tolerance and np.all(
            variation < settings.variation_tolerance
        ):
            break
        before = personal_best[global_best]
        r1, r2 = random.random((2, *place.shape))
        pull = settings.cognitive * r1 * (personal_place - place) + settings.social * r2 * (
            personal_place[global_best] - place
        )
        speed = settings.constriction * (settings.momentum * speed + pull)
        place = np.clip(place + speed, lower, upper)
        found = np.array([objective(x) for x in place])
        better = found < personal_best
        personal_place[better], personal_best[better] = place[better], found[better]
    global_best = int(np.argmin(personal_best))
    return personal_place[global_best], float(personal_best[global_best])


def _run_objective(simulator: Simulator, recording: Recording, values: Array) -> float:
    start = np.concatenate([recording.theta[0], np.zeros(recording.n_joints)])
    run = simulator.run(start, recording.times, recording.inputs_for(simulator.model), values)
    if run.status is not SimulationStatus.COMPLETE:
        return float("inf")
    return rate_nrmse(Reading(run.times, run.theta, run.theta_rate, float(run.times[0])), recording)

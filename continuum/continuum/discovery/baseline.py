"""Fit of the baseline, the model without further effects, and smoothing of its trajectories."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from continuum.discovery.coordinates import coordinates
from continuum.discovery.gauss_newton import modes_along, moved
from continuum.discovery.problem import Problem, State, linearise, near
from continuum.dynamics.measuring import lateness
from continuum.dynamics.model import InputKind, Model
from continuum.errors import InvalidValueError
from continuum.estimation.friction_modes import friction_modes
from continuum.estimation.run import Run
from continuum.estimation.sensor_noise import SLOW, NoiseModel, white_noise
from continuum.estimation.structure import Structure
from continuum.recordings.recording import Recording

LEVELS = 0.005 * 2.0 ** np.arange(6)
"""Levels of the missing torque's standard deviation, as fractions of the arm's torque: from below any model's error to
where a model is useless."""
_FIRST_LEVELS = (5, 5, 4)  # of the first iterations: high, so that a wrong model does not distort the trajectories
_VARYING = 4  # distinct rows of inputs; fewer are a hold and a release
_MOST_ITERATIONS, _SETTLED = 4, 2.0  # most steps, and change of log-evidence below which they end


def problem_of(structure: Structure, recordings: Sequence[Recording]) -> Problem:
    """Return what stays fixed during a search."""
    with_rates = all(recording.theta_rate is not None for recording in recordings)
    runs = tuple(run_of(recording, structure.given, with_rates) for recording in recordings)
    common = coordinates(structure, runs)
    n = structure.n
    noise = NoiseModel(white_noise(runs), np.full(n, SLOW), np.full(n, common.torque))
    return Problem(structure, common, runs, noise, np.asarray(LEVELS, dtype=float))


def run_of(recording: Recording, model: Model, with_rates: bool = True) -> Run:
    """Return the rows of a recording with inputs of the model's kind, and its rates if ``with_rates``."""
    n = recording.n_joints
    if recording.times.size < 8:
        raise InvalidValueError(f"rows of {recording.name}", recording.times.size, "8 or more")
    inputs = recording.inputs_for(model).later(lateness(model))
    readings = (
        np.hstack([recording.theta, recording.theta_rate])
        if with_rates and recording.theta_rate is not None
        else recording.theta
    )
    return Run(
        recording.name, recording.times, np.ascontiguousarray(readings), np.ones_like(readings), n,
        (np.asarray(inputs.times, dtype=float), np.asarray(inputs.values, dtype=float)),
    )  # fmt: skip


def fitted_baseline(problem: Problem) -> State:
    """Smooth and refit, first with much missing torque allowed, then at its most probable level."""
    s = problem.structure
    stribeck = np.full(s.n, 0.0)
    ways = tuple(run.first_guess() for run in problem.runs)
    modes = tuple(friction_modes(run, way, stribeck) for run, way in zip(problem.runs, ways, strict=True))
    none: tuple[dict[tuple[str, str, int], float], ...] = tuple({} for _ in problem.runs)
    state = State({}, none, {}, {}, 1.6, ways, modes)
    for level in _FIRST_LEVELS:
        lin = linearise(problem, state, [level], live=())
        state = moved(lin, (), 0, level)
        state = replace(state, modes=modes_along(problem, state))
    before, levels = -np.inf, [*range(len(problem.levels))]
    for iteration in range(_MOST_ITERATIONS):
        lin = linearise(problem, state, levels, live=())
        after, level = lin.evidence.total(()), lin.evidence.best_level(())
        if abs(after - before) < _SETTLED:
            break
        before, state = after, moved(lin, (), level, levels[level])
        levels = near(problem, levels[level])
        if iteration == 0:  # rates are known better now; from here on the modes stay fixed in the likelihood
            state = replace(state, modes=modes_along(problem, state))
            before = -np.inf
    return state


def with_linear_inputs(problem: Problem) -> Problem | None:
    """Return the problem with inputs linear between rows, as if measured; None if no input varies.

    Commands hold from row to row. Mistaking one kind for the other shifts the inputs by half a row.
    """
    if all(len(np.unique(run.signal[1], axis=0)) < _VARYING for run in problem.runs):
        return None
    return replace(problem, runs=tuple(run.with_held(False) for run in problem.runs))


def has_tension(recordings: Sequence[Recording], model: Model) -> bool:
    """Whether inputs drive the arm and do not only hold it before a release."""
    if model.inputs is not InputKind.CABLES:
        return True
    return any(int(np.sum(np.any(run_of(one, model).inputs > 0.3, axis=1))) > 12 * 2 for one in recordings)

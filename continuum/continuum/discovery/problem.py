"""The state of a search: values and trajectories, linearised together."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.coordinates import Coordinates
from continuum.discovery.evidence import Evidence, Nuisance
from continuum.discovery.hand_measurement import HandMeasurement
from continuum.discovery.library import Library
from continuum.estimation.augmented_filter import Measurement, RunLikelihood, run_likelihood
from continuum.estimation.columns import Scene, assembled, to_states
from continuum.estimation.friction_modes import FrictionModes
from continuum.estimation.run import Run, Trajectory, substep_motion
from continuum.estimation.sensor_noise import NoiseModel
from continuum.estimation.structure import Point, Structure, absent_values
from continuum.estimation.transition import Transition, transition

type ValueKey = tuple[str, str, int]
"""Effect ("" for the baseline), parameter, and joint from 0 (-1 if it belongs to none)."""
type Values = Mapping[ValueKey, float]
"""Coefficients by what they belong to."""


@dataclass(frozen=True)
class Problem:
    """What stays fixed during a search.

    Attributes:
        structure, coordinates: structure and coordinates of the model.
        runs: recordings.
        noise: noise of sensors; its sigma is the unit of the levels, (n,) [N m].
        levels: multiples of that sigma.
        measured: values of effects that were measured by hand.
        zeroed: numbers of the recordings before which the sensors' zeros were set by hand.
    """

    structure: Structure
    coordinates: Coordinates
    runs: tuple[Run, ...]
    noise: NoiseModel
    levels: Array
    measured: tuple[HandMeasurement, ...] = ()
    zeroed: frozenset[int] = frozenset()


@dataclass(frozen=True)
class State:
    """The point that a search has reached.

    Attributes:
        shared: coefficients of the compiled model and the sensors, common to all recordings.
        per_run: per-run coefficients, by recording.
        active: values of the effects in the model that have states or a fitted shape.
        held: coefficients of columns of torque that are in the nominal motion, by name.
        ratio: factor by which active values are changed for finite differences.
        ways: trajectories.
        modes: friction modes.
        rate_sd: standard deviations of the smoothed rates, (n_times, n) each [rad/s]; empty at first.
    """

    shared: Values
    per_run: tuple[Values, ...]
    active: Mapping[str, Mapping[str, Array]]
    held: Mapping[str, float]
    ratio: float
    ways: tuple[Trajectory, ...]
    modes: tuple[FrictionModes, ...]
    rate_sd: tuple[Array, ...] = ()


@dataclass
class Linearised:
    """A state with its columns and likelihoods.

    Attributes:
        problem, state: problem and state about which it is linearised.
        library: hypotheses about this point.
        evidence: evidence of these hypotheses.
        runs: linearised runs.
        theta: coefficients of the columns in the nominal motion of each run, (runs, P).
        levels: levels of the evidence, as indices of the problem's levels.
    """

    problem: Problem
    state: State
    library: Library
    evidence: Evidence
    runs: list[_Run]
    theta: Array
    levels: tuple[int, ...]


@dataclass(frozen=True)
class _Run:
    step: Transition
    seen: Measurement
    columns: tuple[Array, Array]


def point_of(problem: Problem, state: State) -> Point:
    """Return the values at a state."""
    s = problem.structure
    base = {(name, joint): value for (effect, name, joint), value in state.shared.items() if effect == ""}
    values = problem.coordinates.values(base)
    _add(values, s, state.shared)
    by_run = []
    for run, per_run in enumerate(state.per_run):
        mine = sensors_at(problem, state, run)
        for (effect, name, joint), value in per_run.items():
            if (slot := s.slots.get(f"{effect}.{name}")) is not None:
                now = values[slot].copy()
                now[max(joint, 0)] += value
                mine.setdefault(effect, {})[name] = now
        by_run.append(mine)
    stateful = {name: per_run for name, per_run in state.active.items() if name in s.stateful}
    return Point(values, stateful, tuple(by_run))


def sensors_at(problem: Problem, state: State, run: int) -> dict[str, dict[str, Array]]:
    """Return the values of the effects on sensors in a recording, by effect and parameter."""
    s = problem.structure
    given = {a.effect.name: dict(a.values) for a in s.given.effects if a.effect in s.sensors}
    found = given | {e.name: absent_values(e, s.n) for e in s.sensors if e.name not in given}
    for (effect, name, joint), value in (*state.shared.items(), *state.per_run[run].items()):
        if effect in found:
            found[effect][name] = found[effect][name].copy()
            found[effect][name][max(joint, 0)] += value
    return found


def _add(values: Array, s: Structure, coefficients: Values) -> None:
    """Add coefficients of effects; sums, as of an effect and an ordinary difference, stay within physical bounds."""
    for (effect, name, joint), value in coefficients.items():
        slot = s.slots.get(f"{effect}.{name}")
        if effect and slot is not None:
            low, high = s.bounds[f"{effect}.{name}"]
            at = slot.start + max(joint, 0)
            values[at] = min(max(values[at] + value, low), high)


def linearise(
    problem: Problem,
    state: State,
    levels: Sequence[int] | None = None,
    live: Collection[str] | None = None,
) -> Linearised:
    """Linearise about a state, and filter every run at some levels of missing torque.

    Args:
        problem, state: problem, and state about which to linearise.
        levels: indices of these levels; all if None.
        live: effects that have hypotheses; all if None.
    """
    s, point = problem.structure, point_of(problem, state)
    library = Library(
        s, state.active, state.ratio, problem.coordinates.columns(point.values), problem.coordinates.covered, live,
        problem.coordinates.lacks_friction,
        {one.key: one.sd for one in problem.measured},
    )  # fmt: skip
    theta = np.stack([_theta(library, state.shared, per_run, state.held) for per_run in state.per_run])
    runs = []
    for r, (run, way, modes) in enumerate(zip(problem.runs, state.ways, state.modes, strict=True)):
        values = point.values_in(s, r)
        none = np.zeros((len(run.length), s.n))
        reference = problem.coordinates.reference
        step = transition(s.equations, run, way, modes, values, reference, none)
        scene = Scene(s, point, r, run, way, substep_motion(run, way, step.slip, step.acceleration), modes.sign)
        torque, reading = assembled(library.columns, scene)
        in_motion = library.held_vector(state.held)
        if np.any(in_motion):  # repeat the nominal motion with the held columns along the same trajectory
            step = transition(s.equations, run, way, modes, values, reference, torque @ in_motion)
        columns = to_states(step.W, torque, run.first)
        seen = s.measurement(run, way, point.by_run[r])
        runs.append(_Run(step, seen, (columns, reading)))
    G, g = problem.coordinates.constraints(point.values, library.columns, library.width)
    columns, sd, most = library.nuisances(problem.coordinates.prior_sd())
    nuisance = Nuisance(columns, sd, G, G @ theta.mean(axis=0) - g, most)
    evidence = Evidence(
        [
            [_likelihood(problem, run, way, lin, theta_r, problem.levels[k])
             for run, way, lin, theta_r in zip(problem.runs, state.ways, runs, theta, strict=True)]
            for k in (range(len(problem.levels)) if levels is None else levels)
        ],
        nuisance, library.hypotheses, library.width, len(problem.levels),
    )  # fmt: skip
    chosen = tuple(range(len(problem.levels)) if levels is None else levels)
    return Linearised(problem, state, library, evidence, runs, theta, chosen)


def near(problem: Problem, level: int) -> list[int]:
    """Return a level of missing torque and its neighbours."""
    return [k for k in (level - 1, level, level + 1) if 0 <= k < len(problem.levels)]


def _likelihood(problem: Problem, run: Run, way: Trajectory, lin: _Run, theta: Array, level: float) -> RunLikelihood:
    """Return a run's likelihood about theta = 0, given a linearisation about ``theta``."""
    noise = problem.noise.at(level * problem.noise.sigma)
    found = run_likelihood(run, way, lin.step, lin.seen, lin.columns, noise)
    energy = found.energy + 2 * found.e @ theta + theta @ found.L @ theta
    return replace(found, e=found.e + found.L @ theta, energy=float(energy))


def _theta(library: Library, shared: Values, per_run: Values, held: Mapping[str, float]) -> Array:
    """Return the coefficients of the columns in the nominal motion and readings of a run, (P,)."""
    theta = library.held_vector(held)
    for key, value in (*shared.items(), *per_run.items()):
        if (column := library.at.get(key)) is not None:
            theta[column] += value
    return theta

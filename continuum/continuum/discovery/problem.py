"""The state of a search: values and trajectories, linearised together, and one Gauss-Newton step from there."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.coordinates import Coordinates
from continuum.discovery.evidence import Evidence, Nuisance, Set
from continuum.discovery.hypotheses import Library
from continuum.estimation.augmented_filter import Measurement, run_likelihood, smoothed
from continuum.estimation.columns import FreeForm, Scene, assembled, to_states
from continuum.estimation.friction_modes import FrictionModes, friction_modes
from continuum.estimation.run import Run, Trajectory, substep_motion
from continuum.estimation.sensor_noise import NoiseModel
from continuum.estimation.structure import Point, Structure, absent_values
from continuum.estimation.transition import Transition, transition

type Values = Mapping[tuple[str, str, int], float]
"""Coefficients by effect, parameter and joint from 0 (-1 for none); the baseline's by ("", name, -1)."""


@dataclass(frozen=True)
class Problem:
    """What does not change during a search.

    Attributes:
        structure, coordinates: of the model.
        runs: recordings.
        noise: of sensors; sigma is the unit of the levels, (n,) [N m].
        levels: multiples of that sigma.
        free_form: torque of any form.
    """

    structure: Structure
    coordinates: Coordinates
    runs: tuple[Run, ...]
    noise: NoiseModel
    levels: Array
    free_form: FreeForm


@dataclass(frozen=True)
class State:
    """Where a search stands.

    Attributes:
        shared: coefficients of the compiled model and the sensors, common to all recordings.
        own: what each recording has for itself.
        active: values of effects with states, and of effects whose shape is fitted, that are in the model.
        held: coefficients of columns of torque that are in the nominal motion, by name.
        ratio: by which active values are changed for differences.
        ways: trajectories.
        modes: of friction.
        rate_sd: standard deviations of the smoothed rates, (n_times, n) each [rad/s]; none at first.
    """

    shared: Values
    own: tuple[Values, ...]
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
        problem, state: of what.
        library: hypotheses about this point.
        evidence: of them.
        runs: linearised runs.
        theta: of each run, what of the columns is in the nominal motion, (runs, P).
        levels: of the evidence, among the problem's.
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
    """Values at a state."""
    s = problem.structure
    base = {name: value for (effect, name, _), value in state.shared.items() if effect == ""}
    values = problem.coordinates.values(base)
    _add(values, s, state.shared)
    by_run = []
    for own in state.own:
        mine: dict[str, dict[str, Array]] = {
            e.name: absent_values(e, s.n) for e in s.sensors if e.name not in {a.effect.name for a in s.given.effects}
        }
        mine |= {a.effect.name: dict(a.values) for a in s.given.effects if a.effect in s.sensors}
        for (effect, name, joint), value in (*state.shared.items(), *own.items()):
            if effect in mine:
                mine[effect][name] = mine[effect][name].copy()
                mine[effect][name][max(joint, 0)] += value
        for (effect, name, joint), value in own.items():
            if (slot := s.slots.get(f"{effect}.{name}")) is not None:
                now = values[slot].copy()
                now[max(joint, 0)] += value
                mine.setdefault(effect, {})[name] = now
        by_run.append(mine)
    stateful = {name: own for name, own in state.active.items() if name in s.stateful}
    return Point(values, stateful, 0.0, tuple(by_run))


def _add(values: Array, s: Structure, coefficients: Values) -> None:
    for (effect, name, joint), value in coefficients.items():
        slot = s.slots.get(f"{effect}.{name}")
        if effect and slot is not None:
            values[slot.start + max(joint, 0)] += value


def linearise(
    problem: Problem,
    state: State,
    levels: Sequence[int] | None = None,
    live: Collection[str] | None = None,
    free_form: bool = False,
    simulable: bool = False,
) -> Linearised:
    """Linearise about a state, and filter every run at some levels of missing torque.

    Args:
        problem, state: what, and where.
        levels: indices of those levels; all without.
        live: effects that have hypotheses; all without.
        free_form: whether a torque of any form is a hypothesis too.
        simulable: whether nuisances that the equations do not have are left out.
    """
    s, point = problem.structure, point_of(problem, state)
    library = Library(
        s, state.active, state.ratio, problem.coordinates.columns(point.values),
        problem.free_form if free_form else None, problem.coordinates.torque, live, simulable,
    )  # fmt: skip
    theta = np.stack([_theta(library, state.shared, own, state.held) for own in state.own])
    runs = []
    for r, (run, way, modes) in enumerate(zip(problem.runs, state.ways, state.modes, strict=True)):
        values = point.values_in(s, r)
        none = np.zeros((len(run.length), s.n))
        reference = problem.coordinates.reference
        step = transition(s.equations, run, way, modes, values, reference, none)
        scene = Scene(s, point, r, run, way, substep_motion(run, way, step.slip, step.acceleration), modes.sign)
        torque, reading = assembled(library.columns, scene)
        in_motion = library.held_vector(state.held)
        if np.any(in_motion):  # the nominal motion once more, with what is held along this very trajectory
            step = transition(s.equations, run, way, modes, values, reference, torque @ in_motion)
        columns = to_states(step.W, torque, run.first)
        seen = s.measurement(run, way, point.by_run[r])
        runs.append(_Run(step, seen, (columns, reading)))
    G, g = problem.coordinates.constraints(point.values, library.columns, library.width)
    columns, sd, most = library.nuisances(problem.coordinates.prior_sd(shapes=not simulable))
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


def _likelihood(problem: Problem, run: Run, way: Trajectory, lin: _Run, theta: Array, level: float):  # type: ignore[no-untyped-def]
    """A run's likelihood about theta = 0, where the linearisation is about ``theta``."""
    noise = problem.noise.at(level * problem.noise.sigma)
    found = run_likelihood(run, way, lin.step, lin.seen, lin.columns, noise)
    energy = found.energy + 2 * found.e @ theta + theta @ found.L @ theta
    return replace(found, e=found.e + found.L @ theta, energy=float(energy))


def _theta(library: Library, shared: Values, own: Values, held: Mapping[str, float]) -> Array:
    """What of every column is in the nominal motion and readings of a run, (P,)."""
    theta = library.held_vector(held)
    for key, value in (*shared.items(), *own.items()):
        if (column := library.at.get(key)) is not None:
            theta[column] += value
    return theta


def moved(lin: Linearised, chosen: Set, level: int, sigma_index: int) -> State:
    """One Gauss-Newton step to the most probable values of a set, trajectories smoothed there.

    Args:
        lin: linearised state.
        chosen: the set.
        level: index among the evidence's levels.
        sigma_index: index among the problem's levels.
    """
    problem, state, library = lin.problem, lin.state, lin.library
    best = lin.evidence.optimum(chosen, level)
    noise = problem.noise.at(problem.levels[sigma_index] * problem.noise.sigma)
    ways, sds, n = [], [], problem.structure.n
    for r, (run, way, one) in enumerate(zip(problem.runs, state.ways, lin.runs, strict=True)):
        theta = best.theta - lin.theta[r]
        if best.local_columns.size:
            theta[best.local_columns] += best.local[r]
        added = one.columns[0] @ theta, one.columns[1] @ theta
        by, variance, _ = smoothed(run, way, one.step, one.seen, added, noise)
        ways.append(way.moved(by))
        sds.append(np.sqrt(np.maximum(variance[:, n : 2 * n], 0.0)))
    shared = {key: float(best.theta[column]) for key, column in library.at.items() if best.theta[column] != 0.0}
    name_of = {column: key for key, column in library.at.items()}
    own = tuple(
        {name_of[int(c)]: float(v) for c, v in zip(best.local_columns, values, strict=True)} for values in best.local
    )
    held = {name: float(best.theta[column]) for name, column in library.torque_only.items()}
    active = library.stepped(chosen, best.values)
    _take_shapes(problem.structure, chosen, best.values, active, shared)
    return replace(state, shared=shared, own=own, held=held, active=active, ways=tuple(ways), rate_sd=tuple(sds))


def _take_shapes(
    s: Structure, chosen: Set, values: Array, active: dict[str, dict[str, Array]], shared: dict[tuple[str, str, int], float]
) -> None:
    """Effects without states that were found at one of several shapes: from now on the shape is a value too."""
    at = 0
    for hypothesis in chosen:
        mine = values[at : at + len(hypothesis.coefficients)]
        at += mine.size
        if hypothesis.effect in s.stateful or hypothesis.start is None or hypothesis.effect in {e.name for e in s.late}:
            continue
        effect = next(e for e in s.offered if e.name == hypothesis.effect)
        for c, value in zip(hypothesis.coefficients, mine, strict=True):
            for joint in c.joints or (-1,):
                shared[(effect.name, c.parameter, joint)] = float(value)
        for name, shape in hypothesis.start.items():
            shared[(effect.name, name, -1)] = float(shape[0]) - (effect.parameters[name].default or 0.0)
        active[effect.name] = {}


def innovations(lin: Linearised, chosen: Set, level: int, sigma_index: int) -> list[Array]:
    """Whitened innovations of every run at a set's optimum, (n_times, n_readings) each."""
    problem, state = lin.problem, lin.state
    best = lin.evidence.optimum(chosen, level)
    noise = problem.noise.at(problem.levels[sigma_index] * problem.noise.sigma)
    found = []
    for r, (run, way, one) in enumerate(zip(problem.runs, state.ways, lin.runs, strict=True)):
        theta = best.theta - lin.theta[r]
        if best.local_columns.size:
            theta[best.local_columns] += best.local[r]
        added = one.columns[0] @ theta, one.columns[1] @ theta
        found.append(smoothed(run, way, one.step, one.seen, added, noise)[2])
    return found


def modes_along(problem: Problem, state: State) -> tuple[FrictionModes, ...]:
    """Friction's modes along the state's trajectories."""
    s = problem.structure
    p = point_of(problem, state).values
    stribeck = p[s.slots["coulomb_friction"]] * p[s.slots["stribeck_gain"]]
    known = state.rate_sd or (None,) * len(problem.runs)
    return tuple(
        friction_modes(run, way, stribeck, sd) for run, way, sd in zip(problem.runs, state.ways, known, strict=True)
    )


"""One Gauss-Newton step: the most probable coefficients of a set become values, and trajectories are smoothed again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.evidence import Optimum, Set
from continuum.discovery.hypotheses import Hypothesis, within
from continuum.discovery.problem import Linearised, Problem, State, point_of
from continuum.estimation.augmented_filter import smoothed
from continuum.estimation.friction_modes import FrictionModes, friction_modes

_STEP = 1.5
"""Largest step of the logarithm of an effect's value, in units of the log ratio of its finite difference."""
_LEAST_SIZE = 0.2
"""Least coefficient of an effect's torque by which a step is divided: a smaller one gives no direction."""


def moved(lin: Linearised, chosen: Set, level: int, sigma_index: int) -> State:
    """Return the state after one step.

    Args:
        lin: linearised state.
        chosen: the set.
        level: index among the evidence's levels.
        sigma_index: index among the problem's levels.
    """
    problem, state, library = lin.problem, lin.state, lin.library
    best, n = lin.evidence.optimum(chosen, level), problem.structure.n
    ways, sds = [], []
    for way, (by, variance) in zip(
        state.ways, smoothed_runs(lin, best, problem.levels[sigma_index] * problem.noise.sigma), strict=True
    ):
        ways.append(way.moved(by))
        sds.append(np.sqrt(np.maximum(variance[:, n : 2 * n], 0.0)))
    shared = {key: float(best.theta[column]) for key, column in library.at.items() if best.theta[column] != 0.0}
    name_of = {column: key for key, column in library.at.items()}
    per_run = tuple(
        {name_of[int(c)]: float(v) for c, v in zip(best.local_columns, values, strict=True)} for values in best.local
    )
    held = {name: float(best.theta[column]) for name, column in library.torque_only.items()}
    active = _stepped(lin, chosen, best.values)
    _take_shapes(lin, chosen, best.values, active, shared)
    return replace(
        state, shared=shared, per_run=per_run, held=held, active=active, ways=tuple(ways), rate_sd=tuple(sds)
    )


def smoothed_runs(lin: Linearised, best: Optimum, sigma: Array) -> Iterator[tuple[Array, Array]]:
    """Yield the smoothed deviations and their variances of every run at an optimum, (n_times, 4 n) each.

    Args:
        lin: linearised state.
        best: coefficients.
        sigma: standard deviation of the missing torque, (n,) [N m].
    """
    noise = lin.problem.noise.at(sigma)
    for r, (run, way, one) in enumerate(zip(lin.problem.runs, lin.state.ways, lin.runs, strict=True)):
        theta = best.theta - lin.theta[r]
        if best.local_columns.size:
            theta[best.local_columns] += best.local[r]
        added = one.columns[0] @ theta, one.columns[1] @ theta
        by, variance, _ = smoothed(run, way, one.step, one.seen, added, noise)
        yield by, variance


def _of_each(chosen: Sequence[Hypothesis], values: Array) -> Iterator[tuple[Hypothesis, Array]]:
    """Yield each hypothesis with its coefficients."""
    at = 0
    for hypothesis in chosen:
        yield hypothesis, values[at : at + len(hypothesis.coefficients)]
        at += len(hypothesis.coefficients)


def _stepped(lin: Linearised, chosen: Set, values: Array) -> dict[str, dict[str, Array]]:
    """Return the values of the chosen nonlinear effects after a step to the coefficients ``values``."""
    active: dict[str, dict[str, Array]] = {}
    library = lin.library
    for hypothesis, mine in _of_each(chosen, values):
        if hypothesis.start is None:
            if hypothesis.effect in library.active:
                active[hypothesis.effect] = {}
            continue
        effect = next(e for e in library.structure.offered if e.name == hypothesis.effect)
        per_run = {name: np.array(value) for name, value in hypothesis.start.items()}
        for c, value in zip(hypothesis.coefficients, mine, strict=True):
            if c.kind == "log":
                factor = library.ratio ** np.clip(value / max(mine[0], _LEAST_SIZE), -_STEP, _STEP)
                per_run[c.parameter] = within(effect.parameters[c.parameter], per_run[c.parameter] * factor)
        if effect.name in active:  # also at another joint
            per_run = {name: np.maximum(value, active[effect.name][name]) for name, value in per_run.items()}
        active[effect.name] = per_run
    return active


def _take_shapes(
    lin: Linearised,
    chosen: Set,
    values: Array,
    active: dict[str, dict[str, Array]],
    shared: dict[tuple[str, str, int], float],
) -> None:
    """Make the shape of effects without states a value as well, from the one of several at which they were found."""
    s = lin.problem.structure
    late = {effect.name for effect in s.late}
    for hypothesis, mine in _of_each(chosen, values):
        if hypothesis.effect in s.stateful or hypothesis.start is None or hypothesis.effect in late:
            continue
        effect = next(e for e in s.offered if e.name == hypothesis.effect)
        for c, value in zip(hypothesis.coefficients, mine, strict=True):
            for joint in c.joints or (-1,):
                shared[(effect.name, c.parameter, joint)] = float(value)
        for name, shape in hypothesis.start.items():
            shared[(effect.name, name, -1)] = float(shape[0]) - (effect.parameters[name].default or 0.0)
        active[effect.name] = {}


def modes_along(problem: Problem, state: State) -> tuple[FrictionModes, ...]:
    """Return the friction modes along the state's trajectories."""
    s = problem.structure
    p = point_of(problem, state).values
    stribeck = p[s.slots["coulomb_friction"]] * p[s.slots["stribeck_gain"]]
    known = state.rate_sd or (None,) * len(problem.runs)
    return tuple(
        friction_modes(run, way, stribeck, sd) for run, way, sd in zip(problem.runs, state.ways, known, strict=True)
    )

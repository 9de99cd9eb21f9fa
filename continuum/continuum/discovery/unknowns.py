"""The unknowns of a set of effects in the exact equations: all that a fit may change, with priors and bounds.

Common to all recordings are the baseline's coordinates, ordinary differences between parts and the coefficients of the
set; for values of effects with states, the unknown is their logarithm. Some effects have per-run values.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.hypotheses import FRICTION, PRIOR, TOLERANCE, Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.problem import Problem, State, ValueKey, Values
from continuum.discovery.search import Found

STEP = 1e-6
"""Step of an unknown for finite differences of what is linear, or nearly so."""

type Start = Mapping[tuple[object, ...], float]
"""Starting values of unknowns, by `Unknown.key`."""


@dataclass(frozen=True)
class Unknown:
    """One unknown number.

    Attributes:
        places: values to which it is added, with factors, or whose logarithm it is.
        is_log: whether it is a logarithm.
        start, mean, sd: start of a fit, and Gaussian prior.
        absent: its value if what it belongs to is absent.
        lower, upper: bounds.
        hypothesis: effect and place of the set that it belongs to; None for the baseline and ordinary differences.
        of_run: number of the recording that it belongs to; None for all.
    """

    places: Mapping[ValueKey, float]
    is_log: bool
    start: float
    mean: float
    sd: float
    lower: float
    upper: float
    hypothesis: Hypothesis | None = None
    of_run: int | None = None
    absent: float = 0.0

    @property
    def place(self) -> tuple[object, ...]:
        """What it changes."""
        return (*self.places.items(), self.is_log, self.of_run)

    @property
    def key(self) -> tuple[object, ...]:
        """Identity in any set: distinguishes, say, an effect's size from an ordinary difference of the same value."""
        return self.place, None if self.hypothesis is None else self.hypothesis.key


def shifted(state: State, unknown: Unknown, run: int, step: float = STEP) -> State:
    """Return a state with one unknown changed by a step, in one recording if it is a per-run unknown."""
    if unknown.is_log:
        active = {effect: {n: np.array(v) for n, v in values.items()} for effect, values in state.active.items()}
        for effect, name, joint in unknown.places:
            active[effect][name][max(joint, 0)] *= np.exp(step)
        return replace(state, active=active)
    values = dict(state.shared if unknown.of_run is None else state.per_run[run])
    for key, factor in unknown.places.items():
        values[key] = values.get(key, 0.0) + factor * step
    if unknown.of_run is None:
        return replace(state, shared=values)
    return replace(state, per_run=(*state.per_run[:run], values, *state.per_run[run + 1 :]))


class Unknowns:
    """Coordinates of a state.

    Args:
        problem: problem with structure and recordings.
        found: set of effects with the state in which a search left it.
        start: starting values of some of them; others start where the search left them.

    Attributes:
        common: unknowns common to all recordings.
        per_run: unknowns of each recording.
    """

    def __init__(self, problem: Problem, found: Found, start: Start) -> None:
        self._problem, self._found, self._state = problem, found, found.lin.state
        self.common = [*self._set(), *self._baseline()]
        self.common = [_beginning(one, start) for one in (*self.common, *self._ordinary())]
        self.per_run = tuple([_beginning(one, start) for one in self._per_run(r)] for r in range(len(problem.runs)))

    @property
    def all(self) -> list[Unknown]:
        """All unknowns: the common ones, then those of each recording."""
        return [*self.common, *(one for those in self.per_run for one in those)]

    @property
    def per_run_start(self) -> tuple[Array, ...]:
        """Starting values of the per-run unknowns, by recording."""
        return tuple(np.array([one.start for one in mine]) for mine in self.per_run)

    def with_lists(self, common: Sequence[Unknown], per_run: Sequence[Sequence[Unknown]]) -> Unknowns:
        """Return other unknowns about the same state."""
        other = copy(self)
        other.common, other.per_run = list(common), tuple(list(those) for those in per_run)
        return other

    def about(self, state: State, common: Sequence[Unknown], per_run: Sequence[Sequence[Unknown]]) -> Unknowns:
        """Return other unknowns about another state of the same set."""
        other = self.with_lists(common, per_run)
        other._state = state
        return other

    def state(self, common: Array, per_run: tuple[Array, ...]) -> State:
        """Return the state with values at these coordinates, (k,) and (m,) for each recording."""
        free = {key for one in self.common for key in one.places}
        absent = {("", *one): value for one, value in self._problem.coordinates.without_friction.items()}
        shared: dict[ValueKey, float] = {key: value for key, value in absent.items() if key not in free}
        active = {effect: {n: np.array(v) for n, v in values.items()} for effect, values in self._state.active.items()}
        for unknown, value in zip(self.common, common, strict=True):
            for key, factor in unknown.places.items():
                if unknown.is_log:
                    effect, name, joint = key
                    active[effect][name][max(joint, 0)] = np.exp(value)
                else:
                    shared[key] = shared.get(key, 0.0) + factor * float(value)
        by_run = tuple(
            {key: float(value) for unknown, value in zip(mine, values, strict=True) for key in unknown.places}
            for mine, values in zip(self.per_run, per_run, strict=True)
        )
        return replace(self._state, shared=shared, per_run=by_run, active=active, held={})

    def _set(self) -> list[Unknown]:
        found, at = [], 0
        lin, chosen = self._found.lin, self._found.chosen
        values = lin.evidence.optimum(chosen, lin.evidence.best_level(chosen)).values
        for h in chosen:
            for k, c in enumerate(h.coefficients):
                if c.kind == "slot":
                    found.append(linear_unknown(h, k, lin.library, float(values[at + k])))
                elif h.effect in self._state.active:
                    found += self._logs(h, c.parameter, c.joints)
            at += len(h.coefficients)
        return list({(tuple(one.places), one.is_log): one for one in found}.values())

    def _logs(self, h: Hypothesis, name: str, joints: tuple[int, ...]) -> list[Unknown]:
        effect = next(e for e in self._problem.structure.offered if e.name == h.effect)
        spec, per_run = effect.parameters[name], self._state.active[h.effect][name]
        where = joints if spec.per_joint else (-1,)
        found = []
        for j in where:
            value = float(per_run[max(j, 0)])
            usual = np.log(spec.typical or value)
            low, high = np.log(max(spec.lower, 1e-12)), np.log(spec.upper)
            found.append(Unknown({(h.effect, name, j): 1.0}, True, np.log(value), usual, np.log(PRIOR), low, high, h))
        return found

    def _baseline(self) -> list[Unknown]:
        coordinates, found = self._problem.coordinates, []
        friction = next((h for h in self._found.chosen if h.effect == FRICTION), None)
        for one, sd, (low, high) in zip(
            coordinates.all, coordinates.prior_sd(False), coordinates.bounds(), strict=True
        ):
            key, absent = ("", *one), coordinates.without_friction.get(one)
            start = float(np.clip(self._state.shared.get(key, 0.0), low, high))
            if absent is None:
                found.append(Unknown({key: 1.0}, False, start, 0.0, float(sd), low, high))
            elif friction is not None:
                found.append(Unknown({key: 1.0}, False, start, 0.0, float(sd), low, high, friction, None, absent))
        return found

    def _ordinary(self) -> list[Unknown]:
        library, found = self._found.lin.library, []
        sds = dict(library.ordinary)
        moved = {key: factor * one.start for one in self.common if not one.is_log for key, factor in one.places.items()}
        for key, column in library.at.items():
            if (sd := sds.get(column)) is None:
                continue
            start = self._state.shared.get(key, 0.0) - moved.get(key, 0.0)
            most = TOLERANCE * sd
            found.append(Unknown({key: 1.0}, False, float(np.clip(start, -most, most)), 0.0, sd, -most, most))
        return found

    def _per_run(self, run: int) -> list[Unknown]:
        values, library = self._state.per_run[run], self._found.lin.library
        return [one for h in self._found.chosen for one in run_unknowns(h, library, run, values)]


def linear_unknown(h: Hypothesis, k: int, library: Library, start: float = 0.0) -> Unknown:
    """Return the unknown of a coefficient of a hypothesis that enters linearly."""
    key_of = {column: key for key, column in library.at.items()}
    factors = h.weights[k] if h.weights else (1.0,) * len(h.columns[k])
    places = {key_of[column]: w for column, w in zip(h.columns[k], factors, strict=True)}
    low = float(h.least[k])
    return Unknown(places, False, max(start, low), 0.0, float(h.sd[k]), low, np.inf, h)


def run_unknowns(h: Hypothesis, library: Library, run: int, values: Values) -> list[Unknown]:
    """Return the per-run unknowns of a hypothesis in one recording, starting at its values."""
    key_of = {column: key for key, column in library.at.items()}
    return [
        Unknown({(key := key_of[column]): 1.0}, False, values.get(key, 0.0), 0.0, float(sd), -np.inf, np.inf, h, run)
        for column, sd in zip(h.local, h.local_sd, strict=True)
    ]


def _beginning(one: Unknown, start: Start) -> Unknown:
    """Return the same unknown with a given start, if there is one, within bounds."""
    return replace(one, start=float(np.clip(start.get(one.key, one.start), one.lower, one.upper)))

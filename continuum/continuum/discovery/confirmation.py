"""Confirmation by the exact equations: open-loop simulation from the smoothed states, without a refit.

What smoothing explains between the samples, a simulation that is left to itself may not confirm. A set of effects is
worth what it closes of the distance between the refitted baseline's open-loop error and the noise.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from continuum.arrays import Array
from continuum.discovery.problem import Problem, State, point_of
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus
from continuum.dynamics.values import with_vector
from continuum.recordings.recording import Recording

_TOLERANCES = Tolerances(1e-3, 1e-4, 0.01)  # errors stay below a hundredth of a degree

SEGMENT = 2.0
"""Longest stretch that is simulated at once [s]: an arm forgets its beginning by friction within about that."""


@dataclass(frozen=True)
class OpenLoop:
    """Simulations of all recordings from a state's estimates.

    Attributes:
        angles: as the sensors would read them, by run, (n_times, n) each [rad]; NaN where a simulation failed.
        errors: root mean square over rows and joints, (runs,) [rad].
        floor: of the sensors' noise [rad].
    """

    angles: tuple[Array, ...]
    errors: Array
    floor: float


class Confirmation:
    """Open-loop simulations of the states of one problem.

    Args:
        problem: whose runs are simulated.
        recordings: with the inputs of the runs.
    """

    def __init__(self, problem: Problem, recordings: tuple[Recording, ...]) -> None:
        self._problem, self._recordings = problem, recordings
        self._simulators: dict[tuple[str, ...], Simulator] = {}

    @cached_property
    def floor(self) -> float:
        """Root mean square of the white noise of an angle [rad]."""
        n = self._problem.structure.n
        return float(np.sqrt(np.mean(np.diag(self._problem.noise.white)[:n])))

    def simulate(self, state: State) -> OpenLoop:
        """Every run from the state's smoothed beginning."""
        point, s = point_of(self._problem, state), self._problem.structure
        angles, errors = [], []
        for r, (run, way, recording) in enumerate(zip(self._problem.runs, state.ways, self._recordings, strict=True)):
            model = extended_model(self._problem, state, r)
            stateful = tuple(active.effect.name for active in model.effects if active.effect.name in s.stateful)
            if stateful not in self._simulators:
                self._simulators[stateful] = Simulator(model, _TOLERANCES)
            simulator = self._simulators[stateful].around(model)
            delay = sum(
                float(own[name][0]) for e in s.late if (own := state.active.get(e.name)) for name in e.parameters
            )
            inputs = replace(recording.inputs_for(s.given), held=run.held)
            q, w = np.full_like(way.q, np.nan), np.full_like(way.q, np.nan)
            for begin, end in _segments(run.times):
                x = _beginning(model, way.q[begin], way.w[begin], run.inputs[run.first[begin]])
                found = simulator.run(x, run.times[begin:end], inputs.later(delay))
                if found.status is SimulationStatus.COMPLETE:
                    q[begin:end], w[begin:end] = found.theta, found.theta_rate
            read = s.readings(run, q, w, point.by_run[r])[:, : s.n]
            angles.append(read)
            off = np.where(run.live[:, : s.n] > 0, read - run.readings[:, : s.n], 0.0)
            errors.append(float(np.sqrt(np.mean(off**2))))
        return OpenLoop(tuple(angles), np.array(errors), self.floor)


def extended_model(problem: Problem, state: State, run: int) -> Model:
    """The model with a state's values, in one recording; effects on sensors are left out."""
    s, point = problem.structure, point_of(problem, state)
    base = with_vector(s.model, point.values_in(s, run))
    added = [ActiveEffect(s.stateful[name].effect, own) for name, own in point.stateful.items()]
    given = [a for a in s.given.effects if a.effect.name in s.stateful and a.effect.name not in point.stateful]
    return replace(base, effects=(*base.effects, *given, *added))


def _segments(times: Array) -> list[tuple[int, int]]:
    """First row and row after the last of each segment."""
    count = max(1, int(np.ceil((times[-1] - times[0]) / SEGMENT - 0.25)))
    edges = np.searchsorted(times, np.linspace(times[0], times[-1], count + 1))
    return [(int(a), int(b) + (b == len(times) - 1)) for a, b in pairwise(edges) if b - a > 1]


def _beginning(model: Model, q: Array, w: Array, u: Array) -> Array:
    parts = [q, w]
    p = model.changed_parameters
    for active in model.effects:
        if active.effect.n_states(model.n_joints):
            parts.append(np.asarray(active.effect.initial_state(q, u, active.values, p), dtype=float))
    return np.concatenate(parts)

"""Open-loop simulation of segments of a recording by the exact equations, with all sensitivities."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.problem import Problem, State, point_of, sensors_at
from continuum.discovery.segment import Segment
from continuum.discovery.unknowns import STEP, Unknown, shifted
from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.measuring import lateness
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus
from continuum.dynamics.trajectory import Trajectory as Motion
from continuum.dynamics.values import parameter_slots, parameter_vector, with_vector
from continuum.estimation.structure import delay_of
from continuum.recordings.recording import Recording

_TOLERANCES = Tolerances(1e-3, 1e-4, 0.01, 2000)  # errors stay below 0.01 degrees; a motion with more steps diverges
_LATER = 0.03  # step in the log of a delay: inputs jump, and so do the steps of an integration
_LEAD_IN = 1.0  # s, two swings of an arm's slowest mode: effects' states forget their initial values


class Simulators:
    """Simulators of one problem's models, one for each set of compiled effects, and their inputs.

    Args:
        problem: problem with the runs.
        recordings: recordings with the inputs of the runs.
        tolerances: tolerances of integration.
    """

    def __init__(
        self, problem: Problem, recordings: tuple[Recording, ...], tolerances: Tolerances = _TOLERANCES
    ) -> None:
        self.problem, self._recordings, self._tolerances = problem, recordings, tolerances
        self._compiled: dict[tuple[str, ...], Simulator] = {}

    def around(self, problem: Problem, recordings: tuple[Recording, ...] | None = None) -> Simulators:
        """Return the same compiled equations for another problem of the same structure; recordings change if given."""
        other = copy(self)
        other.problem, other._recordings = problem, self._recordings if recordings is None else recordings
        return other

    def of(self, model: Model) -> Simulator:
        """Return the compiled equations of a model's effects, with its values."""
        names = tuple(a.effect.name for a in model.effects)
        if names not in self._compiled:
            self._compiled[names] = Simulator(model, self._tolerances)
        return self._compiled[names].around(model)

    def inputs(self, state: State, run: int) -> InputSignal:
        """Return the inputs of a run with the delay of the state."""
        s = self.problem.structure
        delay = sum(float(np.sum(e.late(params))) for e in s.late if (params := state.active.get(e.name)))
        delay += lateness(s.given)
        inputs = self._recordings[run].inputs_for(s.given)
        return replace(inputs, held=self.problem.runs[run].held).later(delay)


class RunSimulation:
    """Simulation of the segments of one run at a state.

    Args:
        simulators: compiled equations.
        state: values, and trajectories near which segments start.
        run: number of the run.
        unknowns: unknowns by which segments are differentiated, in addition to their local ones.
    """

    def __init__(self, simulators: Simulators, state: State, run: int, unknowns: Sequence[Unknown] = ()) -> None:
        self._problem = problem = simulators.problem
        self._r, self._run, self._way = run, problem.runs[run], state.ways[run]
        self._model = extended_model(problem, state, run)
        self._simulator, self._inputs = simulators.of(self._model), simulators.inputs(state, run)
        s, self._params = problem.structure, sensors_at(problem, state, run)
        self._reads = s.reading_jacobian(self._run, self._params)[: s.n]
        sensors, late = {e.name for e in s.sensors}, {(e.name, delay_of(e)) for e in s.late}
        slots = parameter_slots(self._model)
        self._directions = np.zeros((parameter_vector(self._model).size, len(unknowns)))
        self._sensors: dict[int, Mapping[str, Mapping[str, Array]]] = {}
        self._late: dict[int, InputSignal] = {}
        self._shifted: dict[int, Model] = {}
        self._led: dict[int, tuple[Array, Array]] = {}
        for i, unknown in enumerate(unknowns):
            effects = {effect for effect, _, _ in unknown.places}
            if {(effect, name) for effect, name, _ in unknown.places} & late:
                self._late[i] = simulators.inputs(shifted(state, unknown, run, _LATER), run)
            elif effects & sensors:
                self._sensors[i] = sensors_at(problem, shifted(state, unknown, run), run)
            else:
                for at, derivative in _direction(problem, state, slots, unknown).items():
                    self._directions[at, i] = derivative
                if effects & set(s.stateful):
                    self._shifted[i] = extended_model(problem, shifted(state, unknown, run), run)

    def segment(self, rows: slice, local: Array) -> Segment:
        """Simulate one segment.

        Args:
            rows: rows of the run.
            local: local unknowns: offsets from the smoothed angles and rates at the first row, and zeros of the
                sensors, (3 n,) [rad, rad/s, rad].
        """
        n, run, k = self._problem.structure.n, self._run, self._directions.shape[1]
        times, zeros = run.times[rows], local[2 * n :]
        x0, x0_sensitivities = self._beginning(rows.start, local)
        free = np.hstack([self._directions, np.zeros((len(self._directions), 2 * n))])
        found = self._simulator.run(x0, times, self._inputs, free=free, free_initial=x0_sensitivities)
        width = k + 3 * n
        if found.status is not SimulationStatus.COMPLETE:
            return self._failed(rows, width)
        q, w = found.theta, found.theta_rate
        read = self._read(rows, q, w, self._params)
        J = np.zeros((times.size, n, width))
        J[:, :, : k + 2 * n] = self._reads @ found.sensitivities[:, : 2 * n]
        for i, params in self._sensors.items():
            J[:, :, i] = (self._read(rows, q, w, params) - read) / STEP
        for i, inputs in self._late.items():
            later = self._simulator.run(x0, times, inputs)
            if later.status is not SimulationStatus.COMPLETE:
                return self._failed(rows, width)
            J[:, :, i] = (self._read(rows, later.theta, later.theta_rate, self._params) - read) / _LATER
        J[:, :, k + 2 * n :] = np.eye(n)
        residuals, unread = read + zeros - np.nan_to_num(run.readings[rows, :n]), run.live[rows, :n] <= 0
        J[unread], residuals[unread] = 0.0, 0.0
        return Segment.of(self._r, rows, read + zeros, J.reshape(-1, width), residuals.ravel())

    def _failed(self, rows: slice, width: int) -> Segment:
        size, n = len(self._run.times[rows]), self._problem.structure.n
        none = np.full((size, n), np.nan)
        return Segment.of(self._r, rows, none, np.full((size * n, width), np.nan), none.ravel())

    def readings(self, rows: slice, local: Array) -> Array:
        """Simulate `Segment.readings` without derivatives, (rows, n) [rad]."""
        found, n = self.motion(rows, local), self._problem.structure.n
        if found.status is not SimulationStatus.COMPLETE:
            return np.full_like(found.theta, np.nan)
        return self._read(rows, found.theta, found.theta_rate, self._params) + local[2 * n :]

    def motion(self, rows: slice, local: Array) -> Motion:
        """Simulate the motion of some rows."""
        x0, _ = self._beginning(rows.start, local)
        return self._simulator.run(x0, self._run.times[rows], self._inputs)

    def _beginning(self, row: int, local: Array) -> tuple[Array, Array]:
        """Return the state at a row, (n_x,), and its sensitivities to all unknowns except the zeros, (n_x, k + 2 n)."""
        n, k = self._problem.structure.n, self._directions.shape[1]
        q, w = self._way.q[row] + local[:n], self._way.w[row] + local[n : 2 * n]
        states = self._at_rest(q, row)
        sensitivities = np.zeros((2 * n + states.size, k + 2 * n))
        sensitivities[: 2 * n, k:] = np.eye(2 * n)
        if states.size:
            by_angles, sensitivities[2 * n :, :k] = self._rest_sensitivities(q, row)
            sensitivities[2 * n :, k : k + n] = by_angles
        if states.size and row:
            if row not in self._led:
                self._led[row] = self._moved(row)
            moved, by_unknowns = self._led[row]
            states, sensitivities[2 * n :, :k] = states + moved, sensitivities[2 * n :, :k] + by_unknowns
        return np.concatenate([q, w, states]), sensitivities

    def _at_rest(self, q: Array, row: int, model: Model | None = None) -> Array:
        """Return the effects' states of an arm that rests at angles q."""
        model = self._model if model is None else model
        u, p = self._run.inputs[self._run.first[row]], model.changed_parameters
        found = [
            np.asarray(a.effect.initial_state(q, u, a.values, p), dtype=float)
            for a in model.effects
            if a.effect.n_states(q.size)
        ]
        return np.concatenate([np.zeros(0), *found])

    def _rest_sensitivities(self, q: Array, row: int) -> tuple[Array, Array]:
        """Return the sensitivities of the states at rest to the angles, (n_z, n), and to the unknowns, (n_z, k)."""
        at_rest = self._at_rest(q, row)
        by_angles = [(self._at_rest(q + step, row) - at_rest) / STEP for step in STEP * np.eye(q.size)]
        by_unknowns = np.zeros((at_rest.size, self._directions.shape[1]))
        for i, model in self._shifted.items():
            by_unknowns[:, i] = (self._at_rest(q, row, model) - at_rest) / STEP
        return np.stack(by_angles, axis=1), by_unknowns

    def _moved(self, row: int) -> tuple[Array, Array]:
        """Return the difference of effects' states from those at rest, (n_z,), and its derivative, (n_z, k).

        States have a lead-in: they are simulated from earlier smoothed angles and rates, where they start as at rest.
        """
        n, k, times = self._problem.structure.n, self._directions.shape[1], self._run.times
        first = min(int(np.searchsorted(times, times[row] - _LEAD_IN)), row - 1)
        q, w = self._way.q[first], self._way.w[first]
        x0 = np.concatenate([q, w, self._at_rest(q, first)])
        begin = np.concatenate([np.zeros((2 * n, k)), self._rest_sensitivities(q, first)[1]])
        led = times[first : row + 1]
        found = self._simulator.run(x0, led, self._inputs, free=self._directions, free_initial=begin)
        if found.status is not SimulationStatus.COMPLETE:
            return np.zeros(x0.size - 2 * n), np.zeros((x0.size - 2 * n, k))
        by_angles, by_unknowns = self._rest_sensitivities(found.theta[-1], row)
        sensitivities = found.sensitivities[-1, 2 * n :] - by_angles @ found.sensitivities[-1, :n] - by_unknowns
        return found.states[-1, 2 * n :] - self._at_rest(found.theta[-1], row), sensitivities

    def _read(self, rows: slice, q: Array, w: Array, params: Mapping[str, Mapping[str, Array]]) -> Array:
        """Return the angles as the sensors read them, without the segment's zeros, (rows, n) [rad]."""
        return self._problem.structure.readings(self._run, q, w, params, rows)[:, : q.shape[1]]


def extended_model(problem: Problem, state: State, run: int) -> Model:
    """Return the model of one recording with a state's values and its effects, except those on sensors."""
    s, point = problem.structure, point_of(problem, state)
    base = with_vector(s.model, point.values_in(s, run))
    named = {effect for values in (state.shared, *state.per_run) for effect, _, _ in values}
    named |= {a.effect.name for a in s.given.effects}
    present = [a for a in base.effects if a.effect.name in named]
    added = [ActiveEffect(s.stateful[name].effect, params) for name, params in point.stateful.items()]
    given = [a for a in s.given.effects if a.effect.name in s.stateful and a.effect.name not in point.stateful]
    return replace(base, effects=(*present, *given, *added))


def _direction(problem: Problem, state: State, slots: Mapping[str, slice], unknown: Unknown) -> Mapping[int, float]:
    """Return d(model's values) / d(unknown) by index among all values; others are zero."""
    found: dict[int, float] = {}
    for (effect, name, joint), factor in unknown.places.items():
        if effect:
            at = slots[f"{effect}.{name}"].start + max(joint, 0)
            found[at] = float(state.active[effect][name][max(joint, 0)]) if unknown.is_log else factor
            continue
        base = {key[1:]: value for key, value in state.shared.items() if key[0] == ""}
        values, one = problem.coordinates.values, (name, joint)
        moved = factor * (values(base | {one: base[one] + STEP}) - values(base)) / STEP
        for key, slot in problem.structure.slots.items():
            if "." not in key:
                found |= zip(range(slots[key].start, slots[key].stop), moved[slot].tolist(), strict=True)
    return found

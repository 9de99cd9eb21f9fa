"""One recording simulated window by window, less what was measured, in units of the noise; with exact slopes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.dynamics.effect import Effect
from continuum.dynamics.measuring import lateness, readings
from continuum.dynamics.model import Model
from continuum.dynamics.reading import Reading
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus, Trajectory
from continuum.dynamics.values import parameter_slots, with_vector
from continuum.identification.arrow_least_squares import Part
from continuum.identification.free import FreeSpace
from continuum.identification.local_slopes import local_slope
from continuum.identification.noise import Noise
from continuum.identification.recording import Recording
from continuum.identification.windows import whitener, window_rows

_ANGLE_UNIT, _RATE_UNIT = np.deg2rad(1.0), 0.1  # of the coordinates of a window's first state [rad, rad/s]
_ANGLE_SPREAD, _RATE_SPREAD = 10.0, 20.0  # prior of these coordinates
_NUDGE = 1e-5  # of a sensor's parameter, in units of its coordinate


@dataclass(frozen=True)
class Memory:
    """States of the effects where a window begins, (n_states,), and their slopes, (n_states, k + 2 n).

    By the shared unknowns, and by those of the window that begins there where they move with it: an arm at rest has its
    effects rest with it.
    """

    states: Array
    slopes: Array


@dataclass(frozen=True)
class WindowAt:
    """One window at one first state: errors and slopes there, and what it hands on to the next window.

    Attributes:
        own: coordinates of its first state, (2 n,).
        part: errors and slopes.
        memory: of the effects.
        end: joint angles and rates where the next window begins, (2 n,) [rad, rad/s].
    """

    own: Array
    part: Part
    memory: Memory
    end: Array


class WindowResidual:
    """The residual of one recording as a function of the shared unknowns and of each window's own.

    A window's own unknowns are the joints' angles and rates where it begins, less those that were measured there and
    what sensors have added to them, (2 n,). Late sensors are tensions that come later. States of effects run on from
    window to window, with their slopes; their own beginning is that of an arm at rest, less what is unknown of it: how
    springs and contacts were left by what came before. The first window has these unknowns, too.

    Args:
        simulator: of the model.
        recording: what was measured.
        number: of the recording in its dataset, from 0.
        noise: of the sensors.
        space: the shared unknowns.
        length: of the windows [s]; None for one window, a free run.

    Attributes:
        spreads: of each window's own unknowns, (2 n,) or, in the first window, (2 n + uncertain states,).
        windows_simulated: how often any window was, so far.
    """

    def __init__(
        self,
        simulator: Simulator,
        recording: Recording,
        number: int,
        noise: Noise,
        space: FreeSpace,
        length: float | None,
    ) -> None:
        self.recording, self.space, self.windows_simulated = recording, space, 0
        self._directions = space.directions_of(number)
        self._simulator, self._model = simulator, simulator.model
        self.rows = window_rows(recording, length)
        n = self._model.n_joints
        self._unit = np.concatenate([np.full(n, _ANGLE_UNIT), np.full(n, _RATE_UNIT)])
        states = np.repeat(
            [a.effect.state_spread for a in self._model.effects], [a.effect.n_states(n) for a in self._model.effects]
        )
        self._uncertain = np.diag(states)[:, states > 0]
        of_motion = np.concatenate([np.full(n, _ANGLE_SPREAD), np.full(n, _RATE_SPREAD)])
        self.spreads = [of_motion for _ in self.rows]
        self.spreads[0] = np.concatenate([of_motion, np.ones(self._uncertain.shape[1])])
        self._measured = [first_state(recording, rows.start) for rows in self.rows]
        self._whiten = [whitener(noise, recording, rows) for rows in self.rows]
        self._of_sensors = _parameters_of_sensors(self._model)
        self._is_late = any(type(a.effect).late is not Effect.late for a in self._model.effects)

    @property
    def errors_by_window(self) -> Array:
        """Number of measured values in each window, (n_windows,)."""
        channels = 1 if self._whiten[0].rate_in_time is None else 2
        rows = np.array([rows.stop - rows.start for rows in self.rows], dtype=float)
        return np.asarray(rows * channels * self._model.n_joints)

    @property
    def start(self) -> list[Array]:
        """Coordinates of the windows' own unknowns before any fit: as measured."""
        return [np.zeros(spread.size) for spread in self.spreads]

    def window(self, window: int, shared: Array, own: Array, memory: Memory | None) -> WindowAt | None:
        """One window whose effects' states begin as the window before left them; without one, as in an arm at rest."""
        memory = memory or self.first_memory(shared, own)
        k, m, extra = shared.size, self._unit.size, memory.states
        p = self.space.origin + self._directions @ shared
        free = np.hstack([self._directions, np.zeros((p.size, own.size))])
        slope0 = np.zeros((m + extra.size, free.shape[1]))
        slope0[:m, :k] = self._motion_slopes(window, p)
        slope0[:m, k : k + m] = np.diag(self._unit)
        slope0[m:, : memory.slopes.shape[1]] = memory.slopes
        slope0[m:, k + m :] = self._uncertain[:, : own.size - m]
        late = self._lateness_slopes(p, free)
        run = self._run(window, p, own, extra, free, slope0, late)
        if run is None or not np.all(np.isfinite(run.slopes)):
            return None
        memory = Memory(run.states[-1, m:], run.slopes[-1, m:, :k])
        seen = self._readings(p, run)
        mine = self._samples(window)
        jacobian = self._whiten[window](*(slope[mine] for slope in self._reading_slopes(p, run, seen, free)))
        part = Part(self._errors(window, seen), jacobian[:, :k], jacobian[:, k:])
        return WindowAt(own, part, memory, run.states[-1, :m])

    def from_state(self, window: int, shared: Array, motion: Array) -> Array:
        """Coordinates of a first state of given angles and rates, (2 n,) [rad, rad/s]."""
        p = self.space.origin + self._directions @ shared
        return np.asarray((motion - self._motion(window, p)) / self._unit)

    def still(self, window: int, slow: float) -> Array:
        """Coordinates of a first state in which joints slower than ``slow`` [rad/s] rest, (2 n,)."""
        n = self._model.n_joints
        rate = self._measured[window][n:]
        at_rest = np.concatenate([np.zeros(n), np.where(np.abs(rate) < slow, -rate / _RATE_UNIT, 0.0)])
        return np.concatenate([at_rest, np.zeros(self.spreads[window].size - at_rest.size)])

    def simulate(self, shared: Array, own: Sequence[Array]) -> Reading | None:
        """What the sensors would read, window after window; None where the model cannot be simulated."""
        p = self.space.origin + self._directions @ shared
        extra = self.first_memory(shared, own[0]).states
        seen = []
        for window in range(len(self.rows)):
            run = self._run(window, p, own[window], extra)
            if run is None:
                return None
            extra = run.states[-1, self._unit.size :]
            seen.append(_cut(self._readings(p, run), self._samples(window)))
        times, theta, rate = (np.concatenate([getattr(s, k) for s in seen]) for k in ("times", "theta", "theta_rate"))
        return Reading(times, theta, rate, seen[0].begun)

    def _run(
        self,
        window: int,
        p: Array,
        own: Array,
        extra: Array,
        free: Array | None = None,
        slope0: Array | None = None,
        late: Array | None = None,
    ) -> Trajectory | None:
        """One window and the first sample after it, where the states of effects are handed on.

        With the change ``late`` (columns,) [s] of the sensors' lateness d by one unit of each unknown: the states x(t)
        that they show at t are X(t - d) of a motion X that begins in x0 at t0 - d, so that
        dx/dd = (dX/dx0) X'(t0 - d) - X'(t - d).
        """
        self.windows_simulated += 1
        rows, times = self.rows[window], self.recording.times
        of_motion, of_states = own[: self._unit.size], own[self._unit.size :]
        states = extra + self._uncertain[:, : of_states.size] @ of_states
        x0 = np.concatenate([self._motion(window, p) + self._unit * of_motion, states])
        pull, rates = self._pull(p), self._simulator.equations.rates
        if late is not None and slope0 is not None:
            slope0 = slope0 + np.outer(rates(x0, pull.at(times[rows.start]), p), late)
        run = self._simulator.run(x0, times[rows.start : rows.stop + 1], pull, p, free, slope0)
        if run.status is not SimulationStatus.COMPLETE:
            return None
        if late is None:
            return run
        moving = np.stack([rates(x, pull.at(t), p) for t, x in zip(run.times, run.states, strict=True)])
        return replace(run, slopes=run.slopes - moving[:, :, None] * late)

    def _pull(self, p: Array) -> Tensions:
        """Tensions of the cables by the sensors' clock."""
        return self.recording.pull.later(lateness(with_vector(self._model, p)) if self._is_late else 0.0)

    def _lateness_slopes(self, p: Array, free: Array) -> Array | None:
        """Change of the sensors' lateness by one unit of each unknown, (columns,) [s]."""
        if not self._is_late:
            return None
        here = lateness(with_vector(self._model, p))
        there = [lateness(with_vector(self._model, p + _NUDGE * column)) for column in free.T]
        return (np.array(there) - here) / _NUDGE

    def _motion(self, window: int, p: Array) -> Array:
        """Joint angles and rates that the measured ones mean where a window begins, to first order, (2 n,)."""
        measured, n = self._measured[window], self._model.n_joints
        if not self._of_sensors.size:
            return measured
        times = self.recording.times[self.rows[window].start :][:1]
        alone = Trajectory(SimulationStatus.COMPLETE, times, measured[None], n, 0, 0, np.zeros((1, measured.size, 0)))
        seen = self._readings(p, alone)
        return np.asarray(2 * measured - np.concatenate([seen.theta[0], seen.theta_rate[0]]))

    def _motion_slopes(self, window: int, p: Array) -> Array:
        """Their change by one unit of each shared unknown, (2 n, k)."""
        slopes = np.zeros((self._unit.size, self._directions.shape[1]))
        here = self._motion(window, p)
        for column in np.flatnonzero(self._directions[self._of_sensors].any(axis=0)):
            slopes[:, column] = (self._motion(window, p + _NUDGE * self._directions[:, column]) - here) / _NUDGE
        return slopes

    def first_memory(self, shared: Array, own: Array) -> Memory:
        """States of the effects at the first sample, as in an arm at rest."""
        n, of_motion = self._model.n_joints, own[: self._unit.size]
        if not self._model.n_states:
            return Memory(np.zeros(0), np.zeros((0, shared.size)))
        p = self.space.origin + self._directions @ shared
        u = self._pull(p).at(self.recording.times[0])

        def states(by: Array) -> Array:
            values = p + self._directions @ by[: shared.size]
            model = with_vector(self._model, values)
            theta = (self._motion(0, values) + self._unit * (of_motion + by[shared.size :]))[:n]
            return np.concatenate([a.effect.initial_state(theta, u, a.values, model.parameters) for a in model.effects])

        begin = states(np.zeros(shared.size + of_motion.size))
        slopes = [(states(_NUDGE * unit) - begin) / _NUDGE for unit in np.eye(shared.size + of_motion.size)]
        return Memory(begin, np.stack(slopes, axis=1))

    def _reading_slopes(self, p: Array, run: Trajectory, seen: Reading, free: Array) -> tuple[Array, Array]:
        """Change of angles and rates as sensors read them by one unit of each unknown, (n_times, n, columns) each."""
        n = run.n_joints
        angle, rate = run.slopes[:, :n].copy(), run.slopes[:, n : 2 * n].copy()
        if not self._of_sensors.size:
            return angle, rate
        model = with_vector(self._model, p)
        for column in range(free.shape[1]):
            # measuring is affine in the motion, so that one whole slope may be added to it
            moved = self._read(model, _moved(run, run.slopes[:, :, column]))
            nudged = seen
            if np.any(free[self._of_sensors, column]):
                nudged = self._readings(p + _NUDGE * free[:, column], run)
            angle[:, :, column] = moved.theta - seen.theta + (nudged.theta - seen.theta) / _NUDGE
            rate[:, :, column] = moved.theta_rate - seen.theta_rate + (nudged.theta_rate - seen.theta_rate) / _NUDGE
        return angle, rate

    def _samples(self, window: int) -> slice:
        """The window's own samples among those simulated."""
        return slice(self.rows[window].stop - self.rows[window].start)

    def _readings(self, p: Array, run: Trajectory) -> Reading:
        return self._read(with_vector(self._model, p), run)

    def _read(self, model: Model, run: Trajectory) -> Reading:
        return readings(model, run, float(self.recording.times[0]))

    def _errors(self, window: int, seen: Reading) -> Array:
        rows, rate = self.rows[window], self.recording.theta_rate
        seen = _cut(seen, self._samples(window))
        measured = seen.theta_rate if rate is None else rate[rows]
        return self._whiten[window](seen.theta - self.recording.theta[rows], seen.theta_rate - measured)


def first_state(recording: Recording, row: int) -> Array:
    """Joint angles and rates measured at one sample, (2 n,) [rad, rad/s]; rates by a parabola where they were not."""
    if recording.theta_rate is not None:
        return np.concatenate([recording.theta[row], recording.theta_rate[row]])
    rate = local_slope(recording.times, recording.theta, row, degree=2)
    return np.concatenate([recording.theta[row], rate])


def _parameters_of_sensors(model: Model) -> NDArray[np.intp]:
    """Places of the parameters on which it depends what sensors make of a motion."""
    senses = [a.effect.name for a in model.effects if type(a.effect).measure is not Effect.measure]
    slots = [slot for name, slot in parameter_slots(model).items() if name.partition(".")[0] in senses]
    return np.array([at for slot in slots for at in range(slot.start, slot.stop)], dtype=np.intp)


def _cut(seen: Reading, rows: slice) -> Reading:
    return replace(seen, times=seen.times[rows], theta=seen.theta[rows], theta_rate=seen.theta_rate[rows])


def _moved(run: Trajectory, by: Array) -> Trajectory:
    return Trajectory(run.status, run.times, run.states + by, run.n_joints, run.steps, run.refused, run.slopes)

"""One recording simulated window by window, less what was measured, in units of the noise; with exact slopes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.reading import Reading
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus, Trajectory
from continuum.dynamics.values import with_vector
from continuum.identification.arrow_least_squares import Part
from continuum.identification.free import FreeSpace
from continuum.identification.noise import Noise
from continuum.identification.sensors import NUDGE, Sensors, first_state
from continuum.identification.windows import whitener, window_rows
from continuum.recordings.recording import Recording

_ANGLE_UNIT, _RATE_UNIT = np.deg2rad(1.0), 0.1  # of the coordinates of a window's first state [rad, rad/s]
_ANGLE_SPREAD, _RATE_SPREAD = 10.0, 20.0  # prior of these coordinates


@dataclass(frozen=True)
class Memory:
    """States of the effects where a window begins, (n_states,), and their slopes, (n_states, k + 2 n).

    By the k shared unknowns that the recording feels, and by those of the window that begins there where they move with
    it: an arm at rest has its effects rest with it.
    """

    states: Array
    slopes: Array


@dataclass(frozen=True)
class WindowAt:
    """One window at one first state: errors and slopes there, and what it hands on to the next window.

    Attributes:
        own: coordinates of its first state, (2 n,); in the first window also of what is uncertain of effects' states.
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
        self._felt = space.felt_by(number)
        self._directions = space.directions[:, self._felt]
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
        self._sensors = Sensors(self._model, recording)
        self._whiten = [whitener(noise, recording, rows) for rows in self.rows]

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
        k, m, extra = self._felt.size, self._unit.size, memory.states
        p = self._values(shared)
        free = np.hstack([self._directions, np.zeros((p.size, own.size))])
        slope0 = np.zeros((m + extra.size, free.shape[1]))
        slope0[:m, :k] = self._sensors.meant_slopes(self.rows[window].start, p, self._directions)
        slope0[:m, k : k + m] = np.diag(self._unit)
        slope0[m:, : memory.slopes.shape[1]] = memory.slopes
        slope0[m:, k + m :] = self._uncertain[:, : own.size - m]
        late = self._sensors.lateness_slopes(p, free)
        run = self._run(window, p, own, extra, free, slope0, late)
        if run is None or not np.all(np.isfinite(run.slopes)):
            return None
        memory = Memory(run.states[-1, m:], run.slopes[-1, m:, :k])
        seen = self._sensors.readings(p, run)
        mine = self._samples(window)
        jacobian = self._whiten[window](*(slope[mine] for slope in self._sensors.reading_slopes(p, run, seen, free)))
        by_shared = np.zeros((jacobian.shape[0], shared.size))
        by_shared[:, self._felt] = jacobian[:, :k]
        part = Part(self._errors(window, seen), by_shared, jacobian[:, k:])
        return WindowAt(own, part, memory, run.states[-1, :m])

    def motion(self, window: int, shared: Array, own: Array) -> Array:
        """Angles and rates of a first state, (2 n,) [rad, rad/s], of given coordinates."""
        p = self._values(shared)
        return np.asarray(self._sensors.meant(self.rows[window].start, p) + self._unit * own[: self._unit.size])

    def from_state(self, window: int, shared: Array, motion: Array) -> Array:
        """Coordinates of a first state of given angles and rates, (2 n,) [rad, rad/s]."""
        p = self._values(shared)
        return np.asarray((motion - self._sensors.meant(self.rows[window].start, p)) / self._unit)

    def still(self, window: int, slow: float) -> Array:
        """Coordinates of a first state in which joints slower than ``slow`` [rad/s] rest, (2 n,)."""
        n = self._model.n_joints
        rate = first_state(self.recording, self.rows[window].start)[n:]
        at_rest = np.concatenate([np.zeros(n), np.where(np.abs(rate) < slow, -rate / _RATE_UNIT, 0.0)])
        return np.concatenate([at_rest, np.zeros(self.spreads[window].size - at_rest.size)])

    def simulate(self, shared: Array, own: Sequence[Array]) -> Reading | None:
        """What the sensors would read, window after window; None where the model cannot be simulated."""
        p = self._values(shared)
        extra = self.first_memory(shared, own[0]).states
        seen = []
        for window in range(len(self.rows)):
            run = self._run(window, p, own[window], extra)
            if run is None:
                return None
            extra = run.states[-1, self._unit.size :]
            seen.append(_cut(self._sensors.readings(p, run), self._samples(window)))
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
        x0 = np.concatenate([self._sensors.meant(rows.start, p) + self._unit * of_motion, states])
        pull, rates = self._sensors.pull(p), self._simulator.equations.rates
        if late is not None and slope0 is not None:
            slope0 = slope0 + np.outer(rates(x0, pull.at(times[rows.start]), p), late)
        run = self._simulator.run(x0, times[rows.start : rows.stop + 1], pull, p, free, slope0)
        if run.status is not SimulationStatus.COMPLETE:
            return None
        if late is None:
            return run
        moving = np.stack([rates(x, pull.at(t), p) for t, x in zip(run.times, run.states, strict=True)])
        return replace(run, slopes=run.slopes - moving[:, :, None] * late)

    def first_memory(self, shared: Array, own: Array) -> Memory:
        """States of the effects at the first sample, as in an arm at rest."""
        n, of_motion = self._model.n_joints, own[: self._unit.size]
        if not self._model.n_states:
            return Memory(np.zeros(0), np.zeros((0, self._felt.size)))
        p, k = self._values(shared), self._felt.size
        u = self._sensors.pull(p).at(self.recording.times[0])

        def states(by: Array) -> Array:
            values = p + self._directions @ by[:k]
            model = with_vector(self._model, values)
            theta = (self._sensors.meant(0, values) + self._unit * (of_motion + by[k:]))[:n]
            return np.concatenate(
                [a.effect.initial_state(theta, u, a.values, model.changed_parameters) for a in model.effects]
            )

        begin = states(np.zeros(k + of_motion.size))
        slopes = [(states(NUDGE * unit) - begin) / NUDGE for unit in np.eye(k + of_motion.size)]
        return Memory(begin, np.stack(slopes, axis=1))

    def _values(self, shared: Array) -> Array:
        """All values of the model, (n_p,), as the recording feels them."""
        return np.asarray(self.space.origin + self._directions @ shared[self._felt])

    def _samples(self, window: int) -> slice:
        """The window's own samples among those simulated."""
        return slice(self.rows[window].stop - self.rows[window].start)

    def _errors(self, window: int, seen: Reading) -> Array:
        rows, rate = self.rows[window], self.recording.theta_rate
        seen = _cut(seen, self._samples(window))
        measured = seen.theta_rate if rate is None else rate[rows]
        return self._whiten[window](seen.theta - self.recording.theta[rows], seen.theta_rate - measured)


def _cut(seen: Reading, rows: slice) -> Reading:
    return replace(seen, times=seen.times[rows], theta=seen.theta[rows], theta_rate=seen.theta_rate[rows])

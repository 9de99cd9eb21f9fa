"""What a recording's sensors make of a motion, by the flat values of a model: readings, slopes, and the reverse."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.dynamics.effect import Effect
from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.measuring import lateness, readings
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.reading import Reading
from continuum.dynamics.trajectory import SimulationStatus, Trajectory
from continuum.dynamics.values import parameter_slots
from continuum.identification.local_slopes import local_slope
from continuum.recordings.recording import Recording

NUDGE = 1e-5
"""Of a coordinate, by which slopes of sensors and of effects' beginnings are taken."""


class Sensors:
    """The sensors of one recording.

    Args:
        model: whose effects act on what is read.
        recording: what was read.
    """

    def __init__(self, model: Model, recording: Recording) -> None:
        self._model, self._recording = model, recording
        effects = [active.effect for active in model.effects]
        measuring = [effect for effect in effects if type(effect).measure is not Effect.measure]
        late = [effect for effect in effects if type(effect).late is not Effect.late]
        self._effects = [effect for effect in effects if effect in measuring or effect in late]
        self._slots = parameter_slots(model)
        self._is_late = bool(late)
        self._measuring, self._late = self._parameters_of(measuring), self._parameters_of(late)
        self._first_state = cache(partial(first_state, recording))  # asked for at every step of a fit

    def readings(self, p: Array, run: Trajectory) -> Reading:
        """What they read of a motion, or of a part of one."""
        return readings(self._at(p), run, float(self._recording.times[0]))

    def reading_slopes(self, p: Array, run: Trajectory, seen: Reading, free: Array) -> tuple[Array, Array]:
        """Change of the read angles and rates by one unit of each unknown, (n_times, n, columns) each.

        Args:
            p: values.
            run: with slopes.
            seen: what is read of it.
            free: change of the values by one unit of each unknown, (n_p, columns).
        """
        n = run.n_joints
        if not self._measuring.size:
            return run.slopes[:, :n], run.slopes[:, n : 2 * n]
        moved_angle, moved_rate = self._moved_readings(p, run, seen)
        angle, rate = moved_angle - seen.theta[..., None], moved_rate - seen.theta_rate[..., None]
        for column in np.flatnonzero(free[self._measuring].any(axis=0)):
            nudged = self.readings(p + NUDGE * free[:, column], run)
            angle[:, :, column] += (nudged.theta - seen.theta) / NUDGE
            rate[:, :, column] += (nudged.theta_rate - seen.theta_rate) / NUDGE
        return angle, rate

    def _moved_readings(self, p: Array, run: Trajectory, seen: Reading) -> tuple[Array, Array]:
        """What is read of the motion moved by each of its slopes, (n_times, n, columns) each.

        All of them one after the other as one motion, and unmoved at the end to see whether an effect keeps to its
        contract: what it makes of a sample hangs on no other one. Else every motion by itself.
        """
        moves = [*run.slopes.transpose(2, 0, 1), np.zeros_like(run.states)]
        states = np.concatenate([run.states + move for move in moves])
        read = self.readings(p, replace(run, times=np.tile(run.times, len(moves)), states=states))
        shape = (len(moves), *seen.theta.shape)
        angle, rate = read.theta.reshape(shape), read.theta_rate.reshape(shape)
        if not (np.allclose(angle[-1], seen.theta, 0, 1e-9) and np.allclose(rate[-1], seen.theta_rate, 0, 1e-9)):
            each = [self.readings(p, replace(run, states=run.states + move)) for move in moves]
            angle, rate = np.stack([one.theta for one in each]), np.stack([one.theta_rate for one in each])
        return angle[:-1].transpose(1, 2, 0), rate[:-1].transpose(1, 2, 0)

    def meant(self, row: int, p: Array) -> Array:
        """Joint angles and rates that what was read at one sample means, to first order, (2 n,) [rad, rad/s]."""
        read = self._first_state(row)
        if not self._measuring.size:
            return read
        times, n = self._recording.times[row : row + 1], self._model.n_joints
        alone = Trajectory(SimulationStatus.COMPLETE, times, read[None], n, 0, 0, np.zeros((1, read.size, 0)))
        seen = self.readings(p, alone)
        return np.asarray(2 * read - np.concatenate([seen.theta[0], seen.theta_rate[0]]))

    def meant_slopes(self, row: int, p: Array, directions: Array) -> Array:
        """Their change by one unit of each shared unknown, (2 n, k), which changes the values by ``directions``."""
        here = self.meant(row, p)
        slopes = np.zeros((here.size, directions.shape[1]))
        for column in np.flatnonzero(directions[self._measuring].any(axis=0)):
            slopes[:, column] = (self.meant(row, p + NUDGE * directions[:, column]) - here) / NUDGE
        return slopes

    def pull(self, p: Array) -> InputSignal:
        """What drives the arm by the sensors' clock."""
        drive = self._recording.inputs_for(self._model)
        return drive.later(lateness(self._at(p))) if self._is_late else drive

    def lateness_slopes(self, p: Array, free: Array) -> Array | None:
        """Change of the sensors' lateness by one unit of each unknown, (columns,) [s]; None where none is late."""
        if not self._is_late:
            return None
        here, slopes = lateness(self._at(p)), np.zeros(free.shape[1])
        for column in np.flatnonzero(free[self._late].any(axis=0)):
            slopes[column] = (lateness(self._at(p + NUDGE * free[:, column])) - here) / NUDGE
        return slopes

    def _at(self, p: Array) -> Model:
        """The model with its effects on sensors alone, at values p."""
        effects = [
            ActiveEffect(effect, {name: p[self._slots[f"{effect.name}.{name}"]] for name in effect.parameters})
            for effect in self._effects
        ]
        return replace(self._model, effects=tuple(effects))

    def _parameters_of(self, effects: Sequence[Effect]) -> NDArray[np.intp]:
        """Places of the effects' parameters among all values."""
        slots = [self._slots[f"{effect.name}.{name}"] for effect in effects for name in effect.parameters]
        return np.array([at for slot in slots for at in range(slot.start, slot.stop)], dtype=np.intp)


def first_state(recording: Recording, row: int) -> Array:
    """Joint angles and rates read at one sample, (2 n,) [rad, rad/s]; rates by a parabola where they were not."""
    if recording.theta_rate is not None:
        return np.concatenate([recording.theta[row], recording.theta_rate[row]])
    rate = local_slope(recording.times, recording.theta, row, degree=2)
    return np.concatenate([recording.theta[row], rate])

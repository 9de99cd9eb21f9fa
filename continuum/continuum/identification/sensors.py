"""What a recording's sensors make of a motion, by the flat values of a model: readings, slopes, and the reverse."""

from __future__ import annotations

from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.dynamics.effect import Effect
from continuum.dynamics.measuring import lateness, readings
from continuum.dynamics.model import Model
from continuum.dynamics.reading import Reading
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus, Trajectory
from continuum.dynamics.values import parameter_slots, with_vector
from continuum.identification.local_slopes import local_slope
from continuum.identification.recording import Recording

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
        self._parameters = _parameters_of_sensors(model)
        self._first_state = cache(partial(first_state, recording))  # asked for at every step of a fit
        self._is_late = any(type(a.effect).late is not Effect.late for a in model.effects)

    def readings(self, p: Array, run: Trajectory) -> Reading:
        """What they read of a motion, or of a part of one."""
        return self._read(with_vector(self._model, p), run)

    def reading_slopes(self, p: Array, run: Trajectory, seen: Reading, free: Array) -> tuple[Array, Array]:
        """Change of the read angles and rates by one unit of each unknown, (n_times, n, columns) each.

        Args:
            p: values.
            run: with slopes.
            seen: what is read of it.
            free: change of the values by one unit of each unknown, (n_p, columns).
        """
        n = run.n_joints
        angle, rate = run.slopes[:, :n].copy(), run.slopes[:, n : 2 * n].copy()
        if not self._parameters.size:
            return angle, rate
        model = with_vector(self._model, p)
        for column in range(free.shape[1]):
            # measuring is affine in the motion, so that one whole slope may be added to it
            moved = self._read(model, _moved(run, run.slopes[:, :, column]))
            nudged = seen
            if np.any(free[self._parameters, column]):
                nudged = self.readings(p + NUDGE * free[:, column], run)
            angle[:, :, column] = moved.theta - seen.theta + (nudged.theta - seen.theta) / NUDGE
            rate[:, :, column] = moved.theta_rate - seen.theta_rate + (nudged.theta_rate - seen.theta_rate) / NUDGE
        return angle, rate

    def meant(self, row: int, p: Array) -> Array:
        """Joint angles and rates that what was read at one sample means, to first order, (2 n,) [rad, rad/s]."""
        read = self._first_state(row)
        if not self._parameters.size:
            return read
        times, n = self._recording.times[row : row + 1], self._model.n_joints
        alone = Trajectory(SimulationStatus.COMPLETE, times, read[None], n, 0, 0, np.zeros((1, read.size, 0)))
        seen = self.readings(p, alone)
        return np.asarray(2 * read - np.concatenate([seen.theta[0], seen.theta_rate[0]]))

    def meant_slopes(self, row: int, p: Array, directions: Array) -> Array:
        """Their change by one unit of each shared unknown, (2 n, k), which changes the values by ``directions``."""
        here = self.meant(row, p)
        slopes = np.zeros((here.size, directions.shape[1]))
        for column in np.flatnonzero(directions[self._parameters].any(axis=0)):
            slopes[:, column] = (self.meant(row, p + NUDGE * directions[:, column]) - here) / NUDGE
        return slopes

    def pull(self, p: Array) -> Tensions:
        """Tensions of the cables by the sensors' clock."""
        return self._recording.pull.later(lateness(with_vector(self._model, p)) if self._is_late else 0.0)

    def lateness_slopes(self, p: Array, free: Array) -> Array | None:
        """Change of the sensors' lateness by one unit of each unknown, (columns,) [s]; None where none is late."""
        if not self._is_late:
            return None
        here = lateness(with_vector(self._model, p))
        there = [lateness(with_vector(self._model, p + NUDGE * column)) for column in free.T]
        return (np.array(there) - here) / NUDGE

    def _read(self, model: Model, run: Trajectory) -> Reading:
        return readings(model, run, float(self._recording.times[0]))


def first_state(recording: Recording, row: int) -> Array:
    """Joint angles and rates read at one sample, (2 n,) [rad, rad/s]; rates by a parabola where they were not."""
    if recording.theta_rate is not None:
        return np.concatenate([recording.theta[row], recording.theta_rate[row]])
    rate = local_slope(recording.times, recording.theta, row, degree=2)
    return np.concatenate([recording.theta[row], rate])


def _parameters_of_sensors(model: Model) -> NDArray[np.intp]:
    """Places of the parameters on which it depends what sensors make of a motion."""
    senses = [a.effect.name for a in model.effects if type(a.effect).measure is not Effect.measure]
    slots = [slot for name, slot in parameter_slots(model).items() if name.partition(".")[0] in senses]
    return np.array([at for slot in slots for at in range(slot.start, slot.stop)], dtype=np.intp)


def _moved(run: Trajectory, by: Array) -> Trajectory:
    return Trajectory(run.status, run.times, run.states + by, run.n_joints, run.steps, run.refused, run.slopes)

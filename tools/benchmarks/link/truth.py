"""What the emulator wrote down of what really happened, and how far what was published was from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.arrays import Array
from continuum_hw_imu.emulator.truth_file import read_truth
from continuum_hw_imu.protocol.messages import GuardState
from tools.benchmarks.link.latency_probe import State

STILL = np.radians(0.5)
"""A joint that turns slower is at rest [rad/s]."""

REST = 1.0
"""An arm is at rest once it was still for so long [s]."""


@dataclass(frozen=True)
class Truth:
    """Rows of every sample.

    Attributes:
        device: the controller's clock, (rows,) [us].
        time: of this machine's monotonic clock, (rows,) [s].
        angles, rates: (rows, n_joints) [rad], [rad/s].
        set_points, tensions: that the receiver has in force, and that pull, (rows, n_cables) [N].
        states: of the receiver, numbers as in the protocol, (rows,).
    """

    device: Array
    time: Array
    angles: Array
    rates: Array
    set_points: Array
    tensions: Array
    states: Array

    def angles_at(self, times: Array) -> Array:
        """Between the rows, (times, n_joints) [rad]."""
        return np.stack([np.interp(times, self.time, column) for column in self.angles.T], axis=1)

    def resting(self) -> Array:
        """Rows in which all joints are still, and were for the time `REST`, (rows,) bool."""
        moving = np.abs(self.rates).max(axis=1) > STILL
        last_moved = np.maximum.accumulate(np.where(moving, self.time, -np.inf))
        return np.asarray((self.time - np.maximum(last_moved, self.time[0])) >= REST)

    def between(self, begin: float, end: float) -> Truth:
        """The rows of a stretch of time."""
        rows = slice(*np.searchsorted(self.time, (begin, end)))
        return Truth(*(getattr(self, name)[rows] for name in self.__dataclass_fields__))

    def slack_after(self, instant: float) -> float:
        """Time from an instant until all set points are zero for good [s]; infinite where they are not at the end."""
        tight = self.set_points.any(axis=1)
        if tight[-1]:
            return float(np.inf)
        later = self.time[1:][tight[:-1] & ~tight[1:]]  # rows with which slack begins
        return max(0.0, float(later[-1]) - instant) if later.size else 0.0

    def let_go_after(self, instant: float) -> float:
        """Time from an instant until the receiver begins to let go for good [s]; 0 where it did before."""
        following = self.time[self.states == GuardState.FOLLOWING]
        return max(0.0, float(following[-1]) - instant) if following.size else 0.0

    def fastest_rise(self) -> float:
        """Of any set point [N/s]."""
        steps = np.diff(self.set_points, axis=0) / np.diff(self.time)[:, None]
        return float(steps.max(initial=0.0))


def load_truth(path: Path) -> Truth:
    """Of a file that the emulator has closed."""
    found = read_truth(path)
    names = "device_time_us", "monotonic_s", "theta", "theta_rate", "set_point", "tension", "state"
    return Truth(*(found[name] for name in names))


def errors_of(states: Sequence[State], truth: Truth) -> tuple[Array, Array]:
    """Stamps (n,) [s], and published less true angles at them, (n, n_joints) [rad]; none outside of the truth."""
    stamps = np.array([state.stamp for state in states])
    angles = np.array([state.angles for state in states]).reshape(len(states), truth.angles.shape[1])
    inside = (stamps >= truth.time[0]) & (stamps <= truth.time[-1])
    return stamps[inside], angles[inside] - truth.angles_at(stamps[inside])


def rms_of_worst(off: Array) -> float:
    """Root mean square of the joint for which it is largest, of errors (n, n_joints) [rad], in degrees."""
    return float(np.degrees(np.sqrt(np.mean(off**2, axis=0)).max())) if len(off) else float("nan")

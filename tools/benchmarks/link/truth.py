"""The emulator's record of the true motion, and errors of the published values."""

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
"""Rate below which a joint is at rest [rad/s]."""

REST = 1.0
"""Time without motion after which an arm is at rest [s]."""


@dataclass(frozen=True)
class Truth:
    """The true motion, one row per sample.

    Attributes:
        device: time by the controller's clock, (rows,) [us].
        time: time by this machine's monotonic clock, (rows,) [s].
        angles, rates: joint angles and rates, (rows, n_joints) [rad], [rad/s].
        set_points, tensions: set points of the receiver and actual tensions, (rows, n_cables) [N].
        states: states of the receiver, numbers as in the protocol, (rows,).
    """

    device: Array
    time: Array
    angles: Array
    rates: Array
    set_points: Array
    tensions: Array
    states: Array

    def angles_at(self, times: Array) -> Array:
        """Interpolate the angles, (times, n_joints) [rad]."""
        return np.stack([np.interp(times, self.time, column) for column in self.angles.T], axis=1)

    def resting(self) -> Array:
        """Return the rows in which all joints have been still for the time `REST`, (rows,) bool."""
        moving = np.abs(self.rates).max(axis=1) > STILL
        last_moved = np.maximum.accumulate(np.where(moving, self.time, -np.inf))
        return np.asarray((self.time - np.maximum(last_moved, self.time[0])) >= REST)

    def between(self, begin: float, end: float) -> Truth:
        """Return the rows of a time interval."""
        rows = slice(*np.searchsorted(self.time, (begin, end)))
        return Truth(*(getattr(self, name)[rows] for name in self.__dataclass_fields__))

    def slack_after(self, instant: float) -> float:
        """Return the time from an instant until all set points remain zero [s]; infinite if they do not."""
        tight = self.set_points.any(axis=1)
        if tight[-1]:
            return float(np.inf)
        later = self.time[1:][tight[:-1] & ~tight[1:]]  # rows at which slack starts
        return max(0.0, float(later[-1]) - instant) if later.size else 0.0

    def let_go_after(self, instant: float) -> float:
        """Return the time from an instant to the start of the final release [s]; 0 if it started before."""
        following = self.time[self.states == GuardState.FOLLOWING]
        return max(0.0, float(following[-1]) - instant) if following.size else 0.0

    def fastest_rise(self) -> float:
        """Return the largest rate of any set point [N/s]."""
        steps = np.diff(self.set_points, axis=0) / np.diff(self.time)[:, None]
        return float(steps.max(initial=0.0))


def load_truth(path: Path) -> Truth:
    """Load the truth from a file that the emulator has closed."""
    found = read_truth(path)
    names = "device_time_us", "monotonic_s", "theta", "theta_rate", "set_point", "tension", "state"
    return Truth(*(found[name] for name in names))


def errors_of(states: Sequence[State], truth: Truth) -> tuple[Array, Array]:
    """Return stamps (n,) [s] and published minus true angles (n, n_joints) [rad], within the times of the truth."""
    stamps = np.array([state.stamp for state in states])
    angles = np.array([state.angles for state in states]).reshape(len(states), truth.angles.shape[1])
    inside = (stamps >= truth.time[0]) & (stamps <= truth.time[-1])
    return stamps[inside], angles[inside] - truth.angles_at(stamps[inside])


def rms_of_worst(off: Array) -> float:
    """Return the largest root mean square error over the joints, from errors (n, n_joints) [rad], in degrees."""
    return float(np.degrees(np.sqrt(np.mean(off**2, axis=0)).max())) if len(off) else float("nan")

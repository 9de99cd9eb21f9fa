"""A motion, simulated or measured, as a CSV table with the columns of an arm's recordings."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.model import InputKind
from continuum.dynamics.trajectory import Trajectory
from continuum.recordings.motion_columns import TIME, angle_column, rate_column, tension_column, torque_column
from continuum.whole_file import write_table


def write_motion_table(motion: Trajectory, inputs: InputSignal, path: str | Path) -> None:
    """Write time, joint angles, joint rates and cable tensions or joint torques, one row for each output time.

    Raises:
        FileError: the file cannot be written.
    """
    driven, pulled = inputs.over(motion.times), inputs.kind is InputKind.CABLES
    if pulled:
        driven = np.maximum(driven, 0.0)
    numbers = range(1, inputs.n_inputs + 1)
    drives = [tension_column(number) if pulled else torque_column(number) for number in numbers]
    names, columns = _of_joints(motion.times, motion.theta, motion.theta_rate)
    _write(path, [*names, *drives], np.concatenate([columns, driven], axis=1))


def write_measured_motion(times: Array, theta: Array, theta_rate: Array, path: str | Path) -> None:
    """Write joint angles and rates at some times, without tensions.

    Args:
        times: (n_times,) [s].
        theta: joint angles, (n_times, n_joints) [rad].
        theta_rate: joint rates, (n_times, n_joints) [rad/s].
        path: file to write.

    Raises:
        FileError: the file cannot be written.
    """
    _write(path, *_of_joints(times, theta, theta_rate))


def _of_joints(times: Array, theta: Array, theta_rate: Array) -> tuple[list[str], Array]:
    """Return the names of the columns, and the columns."""
    joints = range(1, theta.shape[1] + 1)
    names = [TIME, *map(angle_column, joints), *map(rate_column, joints)]
    return names, np.concatenate([times[:, None], np.degrees(theta), np.degrees(theta_rate)], axis=1)


def _write(path: str | Path, names: list[str], columns: Array) -> None:
    write_table(path, [names, *map(_digits, columns)])


def _digits(row: Array) -> list[str]:
    """Format time to the nanosecond, the rest to nine digits."""
    return [f"{row[0]:.9f}", *(f"{value:.9g}" for value in row[1:])]

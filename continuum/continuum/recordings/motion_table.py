"""A simulated motion as a CSV table, in the columns in which recordings of an arm are read."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import Trajectory
from continuum.errors import FileError
from continuum.recordings.motion_columns import TIME, angle_column, rate_column, tension_column


def write_motion_table(motion: Trajectory, tensions: Tensions, path: str | Path) -> None:
    """Write time, joint angles, joint rates and cable tensions, one row for each output time.

    Raises:
        FileError: the file cannot be written.
    """
    pull = np.maximum([tensions.at(t) for t in motion.times], 0.0)
    joints, cables = range(1, motion.n_joints + 1), range(1, pull.shape[1] + 1)
    names = [TIME, *map(angle_column, joints), *map(rate_column, joints), *map(tension_column, cables)]
    columns = [motion.times[:, None], np.degrees(motion.theta), np.degrees(motion.theta_rate), pull]
    try:
        with Path(path).open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(names)
            writer.writerows(map(_digits, np.concatenate(columns, axis=1)))
    except OSError as error:
        raise FileError(path, f"cannot be written ({error.strerror or error})") from error


def _digits(row: Array) -> list[str]:
    """Time to the nanosecond, the rest to nine digits."""
    return [f"{row[0]:.9f}", *(f"{value:.9g}" for value in row[1:])]

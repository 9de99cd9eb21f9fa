"""The motion of an arm in space as a CSV table: angles, tip, lengths and commands of the cables."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from continuum.dynamics.spatial.arm_model import ArmModel
from continuum.dynamics.spatial.simulation import CableCommands, SpatialMotion, path_lengths, tip_poses
from continuum.recordings.motion_columns import LENGTH, TENSION, TIME
from continuum.whole_file import write_table


def write_spatial_table(
    model: ArmModel, motion: SpatialMotion, commands: CableCommands | None, path: str | Path
) -> None:
    """Write a row for each output time: t_s, an angle for each bend, the tip, lengths, and tensions if they are given.

    Raises:
        FileError: the file cannot be written.
    """
    numbers = range(1, len(model.cable_names) + 1)
    names = [
        TIME,
        *(f"{name}_deg" for name in model.names),
        "tip_x_m",
        "tip_y_m",
        "tip_z_m",
        *map(LENGTH.column, numbers),
    ]
    columns = [
        motion.times[:, None],
        np.degrees(motion.q),
        tip_poses(model, motion.q)[0],
        path_lengths(model, motion.q),
    ]
    if commands is not None and not commands.holds_length.any():
        names += map(TENSION.column, numbers)
        columns.append(commands.over(motion.times))
    rows = np.concatenate(columns, axis=1)
    write_table(path, [names, *([f"{row[0]:.9f}", *(f"{value:.9g}" for value in row[1:])] for row in rows)])

"""How far the bridge's angles were from the emulated arm's."""

from __future__ import annotations

import csv
import time
from pathlib import Path

import numpy as np

from continuum.arrays import Array
from continuum_manipulator.nodekit.stamps import NANOSECONDS


def error_of_angles(heard: list[tuple[int, Array]], truth_file: Path) -> Array:
    """Published less true joint angles, (n, n_joints) [rad]; ``heard`` as (stamp [ns], angles (n_joints,) [rad])."""
    with truth_file.open(newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    table = np.array([row for row in rows if len(row) == len(header)], dtype=float)
    times = table[:, header.index("monotonic_s")]
    angles = table[:, [i for i, name in enumerate(header) if name.rpartition("_")[0] == "theta"]]
    since = time.monotonic() - time.time_ns() / NANOSECONDS  # from ROS time to the truth file's clock
    at = np.array([stamp / NANOSECONDS + since for stamp, _ in heard])
    true = np.stack([np.interp(at, times, column) for column in angles.T], axis=1)
    return np.array([angles for _, angles in heard]) - true


def rms_degrees(difference: Array) -> float:
    """Root mean square of angles [rad], in degrees."""
    return float(np.degrees(np.sqrt(np.mean(difference**2))))

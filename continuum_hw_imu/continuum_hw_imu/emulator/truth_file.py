"""Record of the true motion: one row for every sample of the sensors, with the same device time.

Columns: device_time_us (unwrapped), monotonic_s (of this machine), theta_1.. [rad], theta_rate_1.. [rad/s],
set_point_1.. and tension_1.. [N], state (of the receiver, a number as in the protocol), hand (1 while a hand holds the
arm).
"""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from continuum.arrays import Array
from continuum_hw_imu.emulator.growing_file import GrowingFile

if TYPE_CHECKING:  # readers do not need the emulator
    from continuum_hw_imu.emulator.bench import Bench


class TruthFile:
    """Record that is written row by row and can be read while it grows.

    Raises:
        FileError: the file cannot be written, now or later.
    """

    def __init__(self, path: Path, n_joints: int, n_cables: int) -> None:
        self._file = GrowingFile(path)
        self._writer = csv.writer(self._file)
        names = ["device_time_us", "monotonic_s"]
        names += [f"{name}_{i + 1}" for name in ("theta", "theta_rate") for i in range(n_joints)]
        names += [f"{name}_{j + 1}" for name in ("set_point", "tension") for j in range(n_cables)]
        self._writer.writerow([*names, "state", "hand"])

    def write(self, device: int, real: float, bench: Bench) -> None:
        """Write the row of one sample."""
        guard = bench.controller.guard
        numbers = [*bench.arm.angles, *bench.arm.rates, *guard.set_points, *bench.actuators.tension]
        row = [device, f"{real:.6f}", *(f"{number:.9g}" for number in numbers), int(guard.state)]
        self._writer.writerow([*row, int(bench.hand is not None)])

    def close(self) -> None:
        self._file.close()


def read_truth(path: Path) -> dict[str, Array]:
    """Return the columns by name, (rows,); numbered ones are joined, for example as ``theta``, (rows, n_joints).

    An incomplete last row is omitted.
    """
    with path.open(newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    table = np.array([row for row in rows if len(row) == len(header)], dtype=float).reshape(-1, len(header))
    found: dict[str, list[Array]] = {}
    for name, column in zip(header, table.T, strict=True):
        whole, _, number = name.rpartition("_")
        found.setdefault(whole if number.isdigit() else name, []).append(column)
    return {name: columns[0] if name in header else np.stack(columns, axis=1) for name, columns in found.items()}

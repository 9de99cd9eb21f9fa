"""Recordings that the vendor's app exports from Xsens DOT (now Movella DOT) sensors, one CSV file for each sensor.

Facts are from the vendor's BLE Services Specification (XD0506P rev. C, table 17 and section 3.5.1), User Manual
(XD0502P, section 4.2) and files written by the app; docs/inertial.md states further assumptions. A file is

    sep=,
    DeviceTag:,...            and other lines of `name:,value`, by the app's version
    (empty)
    PacketCounter,SampleTimeFine,Acc_X,Acc_Y,Acc_Z,Gyr_X,Gyr_Y,Gyr_Z,...

with the columns that were chosen at the export, in any order. Other programs join the lines before the columns into
one, leave them out, or separate columns by semicolons or tabs.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.inertial.dot_clock import microseconds
from continuum.inertial.imu_sample import Truths
from continuum.recordings.csv_layout import hint_of_cell, number_of
from continuum.recordings.table_file import Table, read_table

COUNTER, TIME, STATUS = "PacketCounter", "SampleTimeFine", "Status"
CLIP_COUNTS = ("ClipCountAcc", "ClipCountGyr")
FORCE = ("Acc_X", "Acc_Y", "Acc_Z")  # m/s2, with gravity
RATE = ("Gyr_X", "Gyr_Y", "Gyr_Z")  # degrees/s
WRAP = 2**32
"""Microseconds after which `SampleTimeFine` restarts from 0: 71.6 minutes."""

_CLIPPED = 0x003F  # bits of Status: accelerometer x, y, z, gyroscope x, y, z beyond their range
_NEEDED = (TIME, *FORCE, *RATE)
_SYNCED = "synced"
_GRAVITY, _ENOUGH = (5.0, 20.0), 20  # m/s2, range of the median specific force; readings needed to judge it
_SUDDEN = 60_000_000  # microseconds: a time step longer than any pause in a recording


@dataclass(frozen=True)
class DotExport:
    """One sensor's recording.

    Attributes:
        path: path of the file.
        tag: the sensor's name as set in the app, empty if the file has none.
        ticks: ticks of its clock, unwrapped from the first row on, (k,) [microseconds].
        rates: angular rates in the sensor's axes, (k, 3) [rad/s].
        forces: specific forces, (k, 3) [m/s2].
        clipped: readings beyond the range of accelerometer or gyroscope, (k,).
        notes: what was left out, and why.
    """

    path: Path
    tag: str
    ticks: NDArray[np.int64]
    rates: Array
    forces: Array
    clipped: Truths
    notes: tuple[str, ...]

    @property
    def name(self) -> str:
        """Name for messages."""
        return f"{self.path.name} ({self.tag})" if self.tag else self.path.name


def read_dot_export(path: str | Path) -> DotExport:
    """Read one file.

    Raises:
        FileError: it cannot be read, lacks a column, has a cell that is not a number, or time runs backward in it.
    """
    path = Path(path)
    table = read_table(path, TIME, f"{', '.join(_NEEDED)}, as in CSV exports of an Xsens DOT")
    return _export(path, _head(table.before), _columns(table), table.numbers)


def _head(rows: list[list[str]]) -> dict[str, str]:
    """Read what precedes the columns: `name:` and a value in separate cells, or `name: value` in each cell."""
    found = dict[str, str]()
    for row in rows:
        cells = [row[0] + row[1]] if len(row) > 1 and row[0].endswith(":") else row
        found |= {name.strip(): value.strip() for name, colon, value in (one.partition(":") for one in cells) if colon}
    return found


def _rate(head: dict[str, str]) -> float | None:
    """Return the readings a second from the header, as 60 or 60Hz; None if there are none."""
    found = re.match(r"\d+(\.\d+)?", head.get("OutputRate", ""))
    return float(found.group()) if found and float(found.group()) > 0 else None


def _columns(table: Table) -> dict[str, Array]:
    """Read the columns that are used, by name."""
    path, header = table.path, table.header
    missing = [name for name in _NEEDED if name not in header]
    if missing:
        raise FileError(
            path, f"has no column {', '.join(missing)}: choose them at the export; it has {', '.join(header)}"
        )
    wanted = [name for name in (COUNTER, *_NEEDED, STATUS, *CLIP_COUNTS) if name in header]
    for name in wanted:
        if header.count(name) > 1:
            raise FileError(path, f"has the column {name} twice")
    places = [header.index(name) for name in wanted]
    values = np.empty((len(table.rows), len(wanted)))
    for found, number, row in zip(values, table.numbers, table.rows, strict=True):
        found[:] = [_number(path, number, header[place], row[place]) for place in places]
    return dict(zip(wanted, values.T, strict=True))


def _number(path: Path, row: int, column: str, cell: str) -> float:
    try:
        value = number_of(cell)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise FileError(path, f"row {row}, column {column}: {cell!r} is not a number{hint_of_cell(cell)}")
    return value


def _export(path: Path, head: dict[str, str], columns: dict[str, Array], numbers: NDArray[np.int64]) -> DotExport:
    if not numbers.size:
        raise FileError(path, "has no rows")
    wrapped = columns[TIME]
    if np.any((wrapped < 0) | (wrapped >= WRAP) | (wrapped != np.floor(wrapped))):
        at = int(np.argmax((wrapped < 0) | (wrapped >= WRAP) | (wrapped != np.floor(wrapped))))
        raise FileError(
            path, f"row {numbers[at]}: {TIME} is {wrapped[at]:g}; allowed: whole numbers from 0 to 2^32 - 1"
        )
    ticks, unit = microseconds(path, _unwrapped(path, wrapped.astype(np.int64), numbers), _rate(head))
    readings = np.stack([columns[name] for name in (*FORCE, *RATE)], axis=1)
    clipped = (columns.get(STATUS, np.zeros(ticks.size)).astype(np.int64) & _CLIPPED) != 0
    for name in CLIP_COUNTS:
        clipped |= columns.get(name, np.zeros(ticks.size)) > 0
    usual = float(np.median(np.linalg.norm(readings[:, :3], axis=1)))
    if ticks.size >= _ENOUGH and not _GRAVITY[0] < usual < _GRAVITY[1]:
        raise FileError(path, f"Acc_X..Z have a norm of {usual:.3g}; m/s2 with gravity, about 9.81, are needed")
    empty, again = ~readings.any(axis=1), np.diff(ticks, prepend=-1) == 0
    notes = [unit] if unit else []
    synced = head.get("SyncStatus", _SYNCED)
    if synced.lower() != _SYNCED:
        notes.append(
            f"SyncStatus in its header is {synced!r}, not 'Synced': its times may not match those of other sensors"
        )
    notes += [
        f"{_rows(int(rows.sum()))} {why}, left out (first: row {numbers[rows][0]})"
        for rows, why in ((empty, "of nothing but zeros"), (again & ~empty, "with the time of the row before"))
        if rows.any()
    ]
    keep = ~(empty | again)
    return DotExport(
        path,
        head.get("DeviceTag", ""),
        ticks[keep],
        np.radians(readings[keep, 3:]),
        readings[keep, :3],
        clipped[keep],
        tuple(notes),
    )


def _rows(count: int) -> str:
    return "1 row" if count == 1 else f"{count} rows"


def _unwrapped(path: Path, wrapped: NDArray[np.int64], numbers: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return ticks that continue beyond 2^32."""
    steps = np.diff(wrapped)
    steps = np.where(steps < -WRAP // 2, steps + WRAP, steps)
    wrong = (steps < 0) | (steps > _SUDDEN)
    if wrong.any():
        at = int(np.argmax(wrong))
        raise FileError(
            path, f"row {numbers[at + 1]}: time jumps by {steps[at] / 1e6:g} s; are these two recordings in one file?"
        )
    return np.asarray(wrapped[0] + np.concatenate([[0], np.cumsum(steps)]), dtype=np.int64)

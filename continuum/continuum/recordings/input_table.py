"""Inputs of an arm over time from a CSV table: tensions of cables, or torques at joints."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.dynamics.tensions import Tensions
from continuum.errors import FileError
from continuum.recordings.csv_layout import hint_of_cell, number_of
from continuum.recordings.motion_columns import TENSION, TIME, TORQUE, Quantity, tension_column, torque_column
from continuum.recordings.table_file import read_table

_CLOCK = 600.0  # s: a later first time counts from a date, or from the start of a computer
_NO_SECONDS = 1e11  # a later first time is in milliseconds or smaller units


def read_tension_table(path: str | Path) -> Tensions:
    """Read tensions from a table with columns t_s, u1_N and u2_N, in any order and with any others.

    Times of a clock, for instance since 1970, count from the first row.

    Raises:
        FileError: the file cannot be read, a column is missing, or a row (the heading is row 1) holds a value that is
            not a finite number, a tension below 0 or a time that is not after the one before.
    """
    columns = [tension_column(cable + 1) for cable in range(len(SIDES))]
    return Tensions(*_read(path, columns, TENSION, "a planar section", least=0.0))


def read_cable_table(path: str | Path, n_cables: int, quantity: Quantity) -> tuple[Array, Array]:
    """Read times (rows,) [s], and tensions or lengths (rows, n_cables) of all cables of an arm, in the arm's order.

    Raises:
        FileError: as :func:`read_tension_table`.
    """
    return _read(path, [quantity.column(cable + 1) for cable in range(n_cables)], quantity, "the arm", least=0.0)


def read_torque_table(path: str | Path, n_joints: int) -> JointTorques:
    """Read torques from a table with columns t_s, tau1_Nm, .. of each joint; else as :func:`read_tension_table`."""
    columns = [torque_column(joint + 1) for joint in range(n_joints)]
    return JointTorques(*_read(path, columns, TORQUE, "the model", least=-math.inf))


def _read(
    path: str | Path, columns: Sequence[str], quantity: Quantity, driven: str, least: float
) -> tuple[Array, Array]:
    """Read times, (rows,) [s], and values, (rows, columns), none below ``least``."""
    needed = [TIME, *columns]
    found = read_table(path, TIME, ", ".join(needed))
    if not found.rows:
        raise FileError(path, f"has no rows; a heading {','.join(needed)} and rows of numbers are needed")
    names = [name.strip() for name in found.header]
    if more := sorted({name for name in names if quantity.names(name)} - set(columns)):
        raise FileError(path, f"has {', '.join(more)}; {driven} has {' and '.join(columns)}")
    for column in needed:
        if names.count(column) != 1:
            problem = "no column" if column not in names else "more than one column"
            raise FileError(path, f"has {problem} {column}; needed: {', '.join(needed)}")
    places = [(name, names.index(name), -math.inf if name == TIME else least) for name in needed]
    table = np.array([_numbers(path, n, row, places) for n, row in zip(found.numbers, found.rows, strict=True)])
    for i in np.flatnonzero(np.diff(table[:, 0]) <= 0)[:1]:
        raise FileError(path, f"row {found.numbers[i + 1]}: {TIME} {table[i + 1, 0]:g} is not after {table[i, 0]:g}")
    if abs(table[0, 0]) > _NO_SECONDS:
        allowed = "seconds; is this in milliseconds, microseconds or nanoseconds?"
        raise FileError(path, f"row {found.numbers[0]}: {TIME} is {table[0, 0]:g}; allowed: {allowed}")
    begun = table[0, 0] if table[0, 0] > _CLOCK else 0.0
    return table[:, 0] - begun, table[:, 1:]


def _numbers(path: str | Path, number: int, row: list[str], places: Iterable[tuple[str, int, float]]) -> list[float]:
    """Return the numbers of a row's columns, given by name, place and least value."""
    found = []
    for column, place, least in places:
        text = row[place]
        try:
            value = number_of(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or value < least:
            bound = f" >= {least:g}" if math.isfinite(least) else ""
            raise FileError(
                path, f"row {number}: {column} is {text!r}; allowed: a finite number{bound}{hint_of_cell(text)}"
            )
        found.append(value)
    return found

"""Cable tensions over time from a CSV table."""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from continuum.dynamics.planar.cables import SIDES
from continuum.dynamics.tensions import Tensions
from continuum.errors import FileError
from continuum.recordings.csv_layout import hint_of_cell, number_of
from continuum.recordings.motion_columns import TENSION, TIME, tension_column
from continuum.recordings.table_file import read_table

_CLOCK = 600.0  # s: what begins later counts from a date, or from when a computer was started
_NO_SECONDS = 1e11  # what begins later is in milliseconds or less
COLUMNS = (TIME, *(tension_column(cable + 1) for cable in range(len(SIDES))))


def read_tension_table(path: str | Path) -> Tensions:
    """Tensions of a table with the columns :data:`COLUMNS`, in any order and with any others.

    Times of a clock, since 1970 say, count from the first row.

    Raises:
        FileError: the file cannot be read, a column is missing, or a row (the heading is row 1) holds what is no
            number, not finite, a tension below 0 or a time that is not after the one before.
    """
    found = read_table(path, TIME, ", ".join(COLUMNS))
    if not found.rows:
        raise FileError(path, f"has no rows; a heading {','.join(COLUMNS)} and rows of numbers are needed")
    places = _places(path, found.header)
    table = np.array([_numbers(path, n, row, places) for n, row in zip(found.numbers, found.rows, strict=True)])
    for i in np.flatnonzero(np.diff(table[:, 0]) <= 0)[:1]:
        raise FileError(path, f"row {found.numbers[i + 1]}: {TIME} {table[i + 1, 0]:g} is not after {table[i, 0]:g}")
    if abs(table[0, 0]) > _NO_SECONDS:
        allowed = "seconds; is this in milliseconds, microseconds or nanoseconds?"
        raise FileError(path, f"row {found.numbers[0]}: {TIME} is {table[0, 0]:g}; allowed: {allowed}")
    begun = table[0, 0] if table[0, 0] > _CLOCK else 0.0
    return Tensions(table[:, 0] - begun, table[:, 1:])


def _places(path: str | Path, heading: list[str]) -> list[int]:
    names = [name.strip() for name in heading]
    if more := sorted({name for name in names if TENSION.names(name)} - set(COLUMNS)):
        raise FileError(path, f"has {', '.join(more)}; a planar section has {' and '.join(COLUMNS[1:])}")
    for column in COLUMNS:
        if names.count(column) != 1:
            problem = "no column" if column not in names else "more than one column"
            raise FileError(path, f"has {problem} {column}; needed: {', '.join(COLUMNS)}")
    return [names.index(column) for column in COLUMNS]


def _numbers(path: str | Path, number: int, row: list[str], places: Iterable[int]) -> list[float]:
    found = []
    for column, place in zip(COLUMNS, places, strict=True):
        text = row[place]
        try:
            value = number_of(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or (column != TIME and value < 0):
            least = "" if column == TIME else " >= 0"
            raise FileError(
                path, f"row {number}: {column} is {text!r}; allowed: a finite number{least}{hint_of_cell(text)}"
            )
        found.append(value)
    return found

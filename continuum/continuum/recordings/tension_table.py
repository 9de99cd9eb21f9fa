"""Cable tensions over time from a CSV table."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from continuum.dynamics.planar.cables import SIDES
from continuum.dynamics.tensions import Tensions
from continuum.errors import FileError
from continuum.recordings.motion_columns import TIME, tension_column

COLUMNS = (TIME, *(tension_column(cable + 1) for cable in range(len(SIDES))))


def read_tension_table(path: str | Path) -> Tensions:
    """Tensions of a table with the columns :data:`COLUMNS`, in any order and with any others beside them.

    Raises:
        FileError: the file cannot be read, a column is missing, or a row (the heading is row 1) holds what is no
            number, not finite, a tension below 0 or a time that is not after the one before.
    """
    try:
        with Path(path).open(newline="", encoding="utf-8-sig") as file:
            rows = [(number, row) for number, row in enumerate(csv.reader(file), start=1) if row]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise FileError(path, f"cannot be read ({error})") from error
    if len(rows) < 2:
        raise FileError(path, f"has no rows; a heading {','.join(COLUMNS)} and rows of numbers are needed")
    places = _places(path, rows[0][1])
    table = np.array([_numbers(path, number, row, places) for number, row in rows[1:]])
    for i in np.flatnonzero(np.diff(table[:, 0]) <= 0)[:1]:
        raise FileError(path, f"row {rows[i + 2][0]}: {TIME} {table[i + 1, 0]:g} is not after {table[i, 0]:g}")
    return Tensions(table[:, 0], table[:, 1:])


def _places(path: str | Path, heading: list[str]) -> list[int]:
    names = [name.strip() for name in heading]
    for column in COLUMNS:
        if names.count(column) != 1:
            problem = "no column" if column not in names else "more than one column"
            raise FileError(path, f"has {problem} {column}; needed: {', '.join(COLUMNS)}")
    return [names.index(column) for column in COLUMNS]


def _numbers(path: str | Path, number: int, row: list[str], places: Iterable[int]) -> list[float]:
    found = []
    for column, place in zip(COLUMNS, places, strict=True):
        text = row[place].strip() if place < len(row) else ""
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value) or (column != TIME and value < 0):
            least = "" if column == TIME else " >= 0"
            raise FileError(path, f"row {number}: {column} is {text!r}; allowed: a finite number{least}")
        found.append(value)
    return found

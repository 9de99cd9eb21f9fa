"""Tables of numbers in text files, however another program wrote them: one reader for all of them.

The names of the columns stand in the first line that has the one that every such table has. What stands before
it are remarks.
Columns stand between commas, semicolons or tabs; where they are not between commas, decimals may have commas.
"""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from continuum.errors import FileError

SEPARATORS = ",;\t"
_LONGEST_HEAD = 50  # lines before the columns' names
_MOST_COLUMNS = 2000  # an arm of twenty joints has some hundred
_REMARKS = ("#", "%", "//", "sep=")


@dataclass(frozen=True)
class Table:
    """Cells of a file.

    Attributes:
        path: of the file.
        before: lines before the columns' names, as cells.
        header: names of the columns.
        header_row: its number in the file, from 1.
        numbers: of the rows that are not blank, (rows,).
        rows: their cells, decimals with a point; as many as the line has.
    """

    path: Path
    before: list[list[str]]
    header: list[str]
    header_row: int
    numbers: NDArray[np.int64]
    rows: list[list[str]]


def read_table(path: str | Path, key: str) -> Table:
    """Read a file whose columns' names have ``key`` among them; without such a line, the first that is no remark.

    Raises:
        FileError: it cannot be read, is no text, is empty, or has more columns than any arm.
    """
    path, text = Path(path), _text(Path(path))
    lines = text.splitlines()
    at = next((i for i, line in enumerate(lines[:_LONGEST_HEAD]) if key in _cells(line)), None)
    if at is None:
        at = next(
            (i for i, line in enumerate(lines) if line.strip(" " + SEPARATORS) and not line.startswith(_REMARKS)), None
        )
    if at is None:
        raise FileError(path, "is empty")
    separator = _separator(lines[at])
    if lines[at].count(separator) >= _MOST_COLUMNS:
        raise FileError(path, f"has {lines[at].count(separator) + 1} columns in row {at + 1}; allowed: {_MOST_COLUMNS}")
    try:
        cells = [[cell.strip() for cell in row] for row in csv.reader(io.StringIO(text), delimiter=separator)]
    except csv.Error as error:
        raise FileError(path, f"cannot be read as CSV ({error})") from error
    header_row = next((i for i, row in enumerate(cells) if i >= min(at, len(cells) - 1)), 0)
    rows = [(number, row) for number, row in enumerate(cells, start=1) if number > header_row + 1 and any(row)]
    if separator != ",":
        rows = [(number, [cell.replace(",", ".") for cell in row]) for number, row in rows]
    numbers = np.array([number for number, _ in rows], dtype=np.int64)
    return Table(path, cells[:header_row], cells[header_row], header_row + 1, numbers, [row for _, row in rows])


def _text(path: Path) -> str:
    """What a file holds: UTF-8, UTF-16 with its mark, or an old code of one byte a letter."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from error
    try:
        if data.startswith((b"\xff\xfe", b"\xfe\xff")):
            return data.decode("utf-16")
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        if b"\0" in data or data.startswith((b"\xff\xfe", b"\xfe\xff")):
            raise FileError(path, "is no text file: a CSV file is needed") from error
        return data.decode("latin-1")


def _separator(line: str) -> str:
    return max(SEPARATORS, key=line.count)


def _cells(line: str) -> list[str]:
    return [cell.strip().strip('"') for cell in line.split(_separator(line))]

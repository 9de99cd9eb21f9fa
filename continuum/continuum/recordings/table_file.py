"""Tables of numbers in text files, however another program wrote them: one reader for all of them.

The names of the columns stand in the first line that has the one that every such table has; what stands before
it are remarks. Columns stand between commas, semicolons or tabs; where these are not commas, decimals may have some.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from continuum.errors import FileError
from continuum.recordings.csv_layout import hint_of_row, is_number

SEPARATORS = ",;\t"
_LONGEST_HEAD = 50  # lines before the columns' names
_MOST_COLUMNS = 2000  # an arm of twenty joints has some hundred
_BLANK = " " + SEPARATORS
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
        rows: their cells, decimals with a point; as many as the line has, no more than there are names.
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
        FileError: it cannot be read, is no text, is empty, has more columns than any arm, or a row has more cells than
            there are names.
    """
    path = Path(path)
    lines = _text(path).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    at = next((i for i, line in enumerate(lines[:_LONGEST_HEAD]) if key in _names(line)), None)
    if at is None:
        at = next((i for i, line in enumerate(lines) if line.strip(_BLANK) and not line.startswith(_REMARKS)), None)
    if at is None:
        raise FileError(path, "is empty")
    separator = _separator(lines[at])
    if lines[at].count(separator) >= _MOST_COLUMNS:
        raise FileError(path, f"has {lines[at].count(separator) + 1} columns in row {at + 1}; allowed: {_MOST_COLUMNS}")
    try:
        cells = [[cell.strip() for cell in row] for row in csv.reader(lines[at + 1 :], delimiter=separator)]
    except csv.Error as error:
        raise FileError(path, f"cannot be read as CSV ({error})") from error
    rows = [(number, row) for number, row in enumerate(cells, start=at + 2) if any(row)]
    header = _names(lines[at]) if key in _names(lines[at]) else [cell.strip() for cell in lines[at].split(separator)]
    for number, row in rows:
        if key in header and any(row[len(header) :]):
            hint = hint_of_row(row, len(header)) if separator == "," else ""
            raise FileError(path, f"row {number} has {len(row)} cells, the header {len(header)}{hint}")
    if separator != "," and not any("." in cell and is_number(cell) for _, row in rows for cell in row):
        rows = [(number, [cell.replace(",", ".") for cell in row]) for number, row in rows]
    before = [[cell.strip() for cell in line.split(separator)] for line in lines[:at]]
    numbers = np.array([number for number, _ in rows], dtype=np.int64)
    return Table(path, before, header, at + 1, numbers, [row for _, row in rows])


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
        return data.decode("cp1252", errors="replace")


def _separator(line: str) -> str:
    return max(SEPARATORS, key=line.count)


def _names(line: str) -> list[str]:
    """Names of columns in a line, which may be marked as a remark."""
    return [cell.strip().strip('"') for cell in line.lstrip("#% ").split(_separator(line))]

"""Tables of numbers in text files: one reader for the formats of many programs.

The names of the columns are in the line that has a column which every such table has; lines before it are remarks.
Commas, semicolons or tabs separate columns; unless these are commas, decimals may have commas.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from continuum.errors import FileError
from continuum.recordings.csv_layout import hint_of_row, is_number, problem_of_header

SEPARATORS = ",;\t"
_MOST_COLUMNS = 2000  # an arm of twenty joints has some hundred
_BLANK = " " + SEPARATORS
_REMARKS = ("#", "%", "//", "sep=")


@dataclass(frozen=True)
class Table:
    """Cells of a file.

    Attributes:
        path: path of the file.
        before: lines before the columns' names, as cells.
        header: names of the columns, without last columns that have neither a name nor a value.
        header_row: number of the header in the file, from 1.
        numbers: numbers of the rows that are not blank, (rows,).
        rows: their cells, with decimal points; as many as there are names.
    """

    path: Path
    before: list[list[str]]
    header: list[str]
    header_row: int
    numbers: NDArray[np.int64]
    rows: list[list[str]]


def read_table(path: str | Path, key: str, wanted: str) -> Table:
    """Read a file with a column ``key``.

    Args:
        path: path of the file.
        key: name of the column that every such table has.
        wanted: names of all possible columns, in words, for messages.

    Raises:
        FileError: it cannot be read, is not text, is empty, has no header or two, more columns than any arm, or a row
            with more or fewer cells than there are names.
    """
    path = Path(path)
    lines = read_text(path).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    headers = [i for i, line in enumerate(lines) if key in line and key in _names(line)]
    headers = [
        i for i, after in pairwise([*headers, -1]) if after != i + 1
    ]  # a remark may list the names too, just before they come
    if not headers:
        first = next((k for k in enumerate(lines) if k[1].strip(_BLANK) and not k[1].startswith(_REMARKS)), None)
        if first is None:
            raise FileError(path, "is empty")
        raise FileError(path, problem_of_header(first[0] + 1, _names(first[1]), key, wanted))
    if len(headers) > 1:
        raise FileError(path, f"row {headers[1] + 1} is a header again; are these two recordings in one file?")
    (at,) = headers
    separator, header = _separator(lines[at]), _names(lines[at])
    if lines[at].count(separator) >= _MOST_COLUMNS:
        raise FileError(path, f"has {lines[at].count(separator) + 1} columns in row {at + 1}; allowed: {_MOST_COLUMNS}")
    try:
        cells = [[cell.strip() for cell in row] for row in csv.reader(lines[at + 1 :], delimiter=separator)]
    except csv.Error as error:
        raise FileError(path, f"cannot be read as CSV ({error})") from error
    rows = [(number, row) for number, row in enumerate(cells, start=at + 2) if any(row)]
    while not header[-1] and not any(row[len(header) - 1 :] and row[len(header) - 1] for _, row in rows):
        header.pop()
    for number, row in rows:
        if len(row) < len(header) or any(row[len(header) :]):
            hint = hint_of_row(row, len(header), separator)
            raise FileError(path, f"row {number} has {len(row)} cells, the header {len(header)}{hint}")
        del row[len(header) :]
    if separator != "," and not any("." in cell and is_number(cell) for _, row in rows for cell in row):
        rows = [(number, [cell.replace(",", ".") for cell in row]) for number, row in rows]
    before = [[cell.strip() for cell in line.split(separator)] for line in lines[:at]]
    numbers = np.array([number for number, _ in rows], dtype=np.int64)
    return Table(path, before, header, at + 1, numbers, [row for _, row in rows])


def read_text(path: Path) -> str:
    """Read the text of a file in UTF-8, UTF-16 with a byte order mark, or an old encoding of one byte per letter.

    Raises:
        FileError: it cannot be read, or is not text.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from error
    try:
        text = data.decode("utf-16" if data.startswith((b"\xff\xfe", b"\xfe\xff")) else "utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("cp1252", errors="replace")
    if "\0" in text:
        raise FileError(path, "is not a text file: a CSV file is needed, in UTF-8 or in UTF-16 with a byte order mark")
    return text


def _separator(line: str) -> str:
    return max(SEPARATORS, key=line.count)


def _names(line: str) -> list[str]:
    """Return the names of columns in a line, which may be marked as a remark."""
    return [cell.strip().strip('"') for cell in line.lstrip("#% ").split(_separator(line))]

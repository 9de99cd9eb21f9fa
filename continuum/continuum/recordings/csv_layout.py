"""What is probably the matter with a table that is laid out in another way than with commas and decimal points."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

_WHOLE = re.compile(r"[+-]?\d+")
_NO_VALUE = ("", "na", "n/a", "#n/a", "<na>", "null", "none")
_SHOWN = 60  # letters of a row or of its names


def problem_of_header(row: int, header: Sequence[str], key: str, wanted: str) -> str:
    """What the first row of a table without a column ``key`` is, in words, and the ``wanted`` columns."""
    shown = ", ".join(header)
    shown = shown if len(shown) <= _SHOWN else f"{shown[:_SHOWN]} .."
    if all(map(is_number, header)):
        return f"row {row} holds numbers; the first row must be the header, with the names of the columns: {wanted}"
    if len(header) == 1 and key in re.split(r"\W+", header[0]):
        return f"row {row} is {shown!r}; commas, semicolons or tabs must separate the columns: {wanted}"
    return f"has no column {key}; row {row} has {shown}; wanted: {wanted}"


def hint_of_row(values: Sequence[str], n_columns: int, separator: str) -> str:
    """To be added where a row has not as many cells as there are columns, which it shows where it is one cell."""
    if len(values) == 1:
        return f": {values[0][:_SHOWN]!r}"
    halves = separator == "," and n_columns < len(values) <= 2 * n_columns and all(map(_WHOLE.fullmatch, values))
    return "; decimal commas? Decimals must be separated by '.'" if halves else ""


def hint_of_cell(cell: str) -> str:
    """To be added where a cell is no number; empty where nothing is to be guessed."""
    if "," not in cell or not is_number(cell.replace(",", ".")):
        return ""
    return "; decimals must be separated by '.', or all by ',' where ';' or tabs separate columns"


def number_of(cell: str) -> float:
    """Value of a cell, NaN where it says that there is none, as spreadsheets, databases and statistics do.

    Raises:
        ValueError: it is no number. Python's underscores between digits are none.
    """
    if cell.lower() in _NO_VALUE:
        return math.nan
    if "_" in cell:
        raise ValueError(cell)
    return float(cell)


def is_number(cell: str) -> bool:
    """Whether a cell is one that can be read as a number."""
    try:
        number_of(cell)
    except ValueError:
        return False
    return cell.lower() not in _NO_VALUE

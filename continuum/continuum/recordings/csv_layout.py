"""Hints on tables with a layout other than commas and decimal points."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

_WHOLE = re.compile(r"[+-]?\d+")
_NO_VALUE = ("", "na", "n/a", "#n/a", "<na>", "null", "none")
_SHOWN = 60  # letters of a row or of its names


def problem_of_header(row: int, header: Sequence[str], key: str, wanted: str) -> str:
    """Describe the first row of a table without a column ``key``, and the ``wanted`` columns."""
    shown = ", ".join(header)
    shown = shown if len(shown) <= _SHOWN else f"{shown[:_SHOWN]} .."
    if all(map(is_number, header)):
        return f"row {row} holds numbers; the first row must be the header, with the names of the columns: {wanted}"
    if len(header) == 1 and key in re.split(r"\W+", header[0]):
        return f"row {row} is {shown!r}; commas, semicolons or tabs must separate the columns: {wanted}"
    return f"has no column {key}; row {row} has {shown}; wanted: {wanted}"


def hint_of_row(values: Sequence[str], n_columns: int, separator: str) -> str:
    """Return a hint on a row whose number of cells is not that of the columns; a single cell is shown."""
    if len(values) == 1:
        return f": {values[0][:_SHOWN]!r}"
    halves = separator == "," and n_columns < len(values) <= 2 * n_columns and all(map(_WHOLE.fullmatch, values))
    return "; decimal commas? Decimals must be separated by '.'" if halves else ""


def hint_of_cell(cell: str) -> str:
    """Return a hint on a cell that is not a number; empty if there is no guess."""
    if "," not in cell or not is_number(cell.replace(",", ".")):
        return ""
    return "; decimals must be separated by '.', or all by ',' where ';' or tabs separate columns"


def number_of(cell: str) -> float:
    """Return the value of a cell; NaN if it marks a missing value as spreadsheets, databases and statistics do.

    Raises:
        ValueError: it is not a number; digits with underscores, as in Python, are not.
    """
    if cell.lower() in _NO_VALUE:
        return math.nan
    if "_" in cell:
        raise ValueError(cell)
    return float(cell)


def is_number(cell: str) -> bool:
    """Whether a cell can be read as a number."""
    try:
        number_of(cell)
    except ValueError:
        return False
    return cell.lower() not in _NO_VALUE

"""What is probably the matter with a table that is laid out in another way than with commas and decimal points."""

from __future__ import annotations

import re
from collections.abc import Sequence

_WHOLE = re.compile(r"[+-]?\d+")
_NAMES = "t_s, q1_deg .. or q1_rad .., and where there are any dq1_deg_s .., u1_N, u2_N or tau1_Nm .."


def problem_of_header(header: Sequence[str]) -> str:
    """What the first row is or has, in words; empty where it may be one of names between commas."""
    if all(map(is_number, header)):
        return f"holds numbers; the first row must be the header, with the names of the columns: {_NAMES}"
    return ""


def hint_of_row(values: Sequence[str], n_columns: int) -> str:
    """To be added where a row has not as many cells as there are columns; empty where nothing is to be guessed."""
    halves = n_columns < len(values) <= 2 * n_columns and all(map(_WHOLE.fullmatch, values))
    return "; decimal commas? Decimals must be separated by '.'" if halves else ""


def hint_of_cell(cell: str) -> str:
    """To be added where a cell is no number; empty where nothing is to be guessed."""
    return "; decimals must be separated by '.'" if is_number(cell.replace(",", ".")) else ""


def is_number(cell: str) -> bool:
    """Whether a cell can be read as a number."""
    try:
        float(cell)
    except ValueError:
        return False
    return True

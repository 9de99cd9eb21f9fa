"""Tables of numbers as CSV, each written in the same way whatever it holds."""

from collections.abc import Mapping

import numpy as np

DIGITS = {"t": 6, "q": 4, "dq": 3, "u": 4}


def table(columns: Mapping[str, np.ndarray]) -> bytes:
    """CSV of columns of equal length by name; a name's letters say how many digits its numbers have."""
    digits = [DIGITS[name.partition("_")[0].rstrip("0123456789")] for name in columns]
    # + 0.0 turns a negative zero, once rounded, into zero
    rows = zip(*(np.round(column, d) + 0.0 for column, d in zip(columns.values(), digits, strict=True)), strict=True)
    lines = [",".join(f"{value:.{d}f}" for value, d in zip(row, digits, strict=True)) for row in rows]
    return ("\n".join([",".join(columns), *lines]) + "\n").encode()

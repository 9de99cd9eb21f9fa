"""Numbers as text with a few significant digits."""

from __future__ import annotations


def rounded(value: float, digits: int, sign: str = "-") -> str:
    """Format a number to so many significant digits, without an exponent from 0.0001 up to 999999.

    Args:
        value: number.
        digits: number of significant digits; trailing zeros are omitted.
        sign: "+" to show the sign of positive numbers as well.
    """
    return f"{float(f'{value:.{digits}g}'):{sign}g}"

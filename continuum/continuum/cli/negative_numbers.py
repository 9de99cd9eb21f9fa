"""Negative numbers on the command line: argparse treats ``-1e-2`` and ``-1,2`` as options, ``-0.01`` as a number."""

from __future__ import annotations

import re
from collections.abc import Sequence
from decimal import Decimal

_EXPONENT = re.compile(r"-(\d+\.?\d*|\.\d+)[eE][-+]?\d{1,3}")
_LIST = re.compile(r"-[\d.][-+\d.eE]*(,[-+\d.eE]+)+")


def written_out(arguments: Sequence[str]) -> list[str]:
    """Return the arguments, with negative numbers in exponent notation written as exact decimals.

    A list of numbers that starts with a minus sign is joined to the option before it.
    """
    written: list[str] = []
    for text in arguments:
        if _LIST.fullmatch(text) and written and written[-1].startswith("--") and "=" not in written[-1]:
            written[-1] += f"={text}"
        else:
            written.append(format(Decimal(text), "f") if _EXPONENT.fullmatch(text) else text)
    return written

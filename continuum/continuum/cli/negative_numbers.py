"""Negative numbers on the command line: argparse takes ``-1e-2`` for an option, ``-0.01`` for the number that it is."""

from __future__ import annotations

import re
from collections.abc import Sequence
from decimal import Decimal

_EXPONENT = re.compile(r"-(\d+\.?\d*|\.\d+)[eE][-+]?\d{1,3}")


def written_out(arguments: Sequence[str]) -> list[str]:
    """The arguments, negative numbers with an exponent written without it, digit for digit."""
    return [format(Decimal(text), "f") if _EXPONENT.fullmatch(text) else text for text in arguments]

"""One-line error messages of the tools."""

from __future__ import annotations

import sys
from collections.abc import Callable

from continuum.errors import ContinuumError


def in_one_line(main: Callable[[], int | None]) -> int:
    """Run a tool and return its exit code, or 2 after an error line on standard error."""
    try:
        return main() or 0
    except ContinuumError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2

"""A tool that cannot go on says why in one line."""

from __future__ import annotations

import sys
from collections.abc import Callable

from continuum.errors import ContinuumError


def in_one_line(main: Callable[[], int | None]) -> int:
    """Run a tool; its exit code, or 2 after a line on standard error."""
    try:
        return main() or 0
    except ContinuumError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2

"""Checks of the solvers' settings."""

from __future__ import annotations

import numpy as np

from continuum.arm import Arm
from continuum.errors import InvalidValueError

SMALLEST_TOLERANCE = 1e-14
"""Smallest tolerance that rounding allows [m] and [rad]."""


def checked_arm(arm: object) -> Arm:
    """Return ``arm`` if it is an `Arm`.

    Raises:
        InvalidValueError: ``arm`` is not an `Arm`.
    """
    if not isinstance(arm, Arm):
        raise InvalidValueError("arm", arm, "an Arm; continuum.arm.load_arm reads one from a file")
    return arm


def checked_tolerance(tolerance: object) -> float:
    """Return ``tolerance`` [m] and [rad] as a float.

    Raises:
        InvalidValueError: it is not a finite number, or below `SMALLEST_TOLERANCE`.
    """
    if not isinstance(tolerance, float | int | np.floating | np.integer) or isinstance(tolerance, bool):
        raise InvalidValueError("tolerance", tolerance, f"a finite number >= {SMALLEST_TOLERANCE:g}")
    if not SMALLEST_TOLERANCE <= tolerance < np.inf:
        raise InvalidValueError("tolerance", tolerance, f"a finite number >= {SMALLEST_TOLERANCE:g}")
    return float(tolerance)


def checked_count(name: str, count: object, most: int = 100_000) -> int:
    """Return ``count`` if it is a whole number from 0 to ``most``.

    Raises:
        InvalidValueError: it is not such a number.
    """
    if not isinstance(count, int | np.integer) or isinstance(count, bool) or not 0 <= count <= most:
        raise InvalidValueError(name, count, f"a whole number from 0 to {most}")
    return int(count)

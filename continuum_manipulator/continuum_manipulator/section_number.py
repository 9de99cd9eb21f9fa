"""Number of a section, counted from 1 in parameters and messages."""

from __future__ import annotations

from continuum.arm import Arm
from continuum.errors import InvalidValueError


def checked_section(number: int, arm: Arm) -> int:
    """Return ``number`` if the arm has such a section.

    Raises:
        InvalidValueError: the arm does not have this section.
    """
    if not 1 <= number <= arm.n_sections:
        raise InvalidValueError("section", number, f"1 to {arm.n_sections}, the arm's sections counted from the base")
    return number

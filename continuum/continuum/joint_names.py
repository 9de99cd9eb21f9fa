"""Names of the joints and cables of a section in messages, descriptions and files."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable

from continuum.errors import InvalidValueError

DEFAULT_SECTION = "section_1"
"""Name of the section of a model file, which names none."""

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")  # it becomes a part of topic, frame and parameter names
_BENDING = re.compile(r"(?P<section>\w+)_theta_[1-9]\d*")


def check_section(name: object) -> None:
    """Check the name of a section.

    Raises:
        InvalidValueError: the name is not a letter followed by letters, digits and underscores.
    """
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise InvalidValueError("name of section", name, "a letter, then letters, digits and underscores")


def phi_joint(section: str) -> str:
    """Return the name of the joint at the base that rotates the bending plane (thesis appendix A)."""
    return f"{section}_phi"


def theta_joints(section: str, n_joints: int) -> tuple[str, ...]:
    """Return the names of the bending joints from base to tip."""
    return tuple(f"{section}_theta_{k + 1}" for k in range(n_joints))


def bending_joints(names: Iterable[str]) -> dict[str, int]:
    """Return the number of bending joints among the names, by section; other joints do not count."""
    return dict(Counter(match["section"] for match in map(_BENDING.fullmatch, names) if match))


def phi_back_joint(section: str) -> str:
    """Return the name of the joint at the tip that rotates back by -phi."""
    return f"{section}_phi_back"


def cable_names(section: str, n_cables: int) -> tuple[str, ...]:
    """Return the names of the actuating cables, numbered from 1."""
    return tuple(f"{section}_cable_{j + 1}" for j in range(n_cables))

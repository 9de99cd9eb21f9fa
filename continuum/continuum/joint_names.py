"""What the joints and cables of a section are called, in messages, descriptions and files."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable

from continuum.errors import InvalidValueError

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")  # it becomes a part of topic, frame and parameter names
_BENDING = re.compile(r"(?P<section>\w+)_theta_[1-9]\d*")


def check_section(name: object) -> None:
    """Refuse what cannot be a section's name.

    Raises:
        InvalidValueError: no text of a letter, then letters, digits and underscores.
    """
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise InvalidValueError("name of section", name, "a letter, then letters, digits and underscores")


def phi_joint(section: str) -> str:
    """The joint at the base that turns the bending plane (thesis appendix A)."""
    return f"{section}_phi"


def theta_joints(section: str, n_joints: int) -> tuple[str, ...]:
    """The bending joints from base to tip."""
    return tuple(f"{section}_theta_{k + 1}" for k in range(n_joints))


def bending_joints(names: Iterable[str]) -> dict[str, int]:
    """Number of bending joints among these names, by section; other joints do not count."""
    return dict(Counter(match["section"] for match in map(_BENDING.fullmatch, names) if match))


def phi_back_joint(section: str) -> str:
    """The joint at the tip that turns back by -phi."""
    return f"{section}_phi_back"


def cable_names(section: str, n_cables: int) -> tuple[str, ...]:
    """The actuating cables, counted from 1."""
    return tuple(f"{section}_cable_{j + 1}" for j in range(n_cables))

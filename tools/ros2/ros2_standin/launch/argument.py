"""Arguments of launch files."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Argument:
    """One argument of a launch file."""

    name: str
    default: str | None
    description: str
    choices: list[str]

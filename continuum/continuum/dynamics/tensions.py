"""Tensions of the cables over time: what pulls at the base."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.model import InputKind
from continuum.dynamics.planar.cable_tension import SIDES
from continuum.errors import InvalidValueError

LET_GO = -1e-3
"""Tension [N] that says that a cable is let go: no motor lets it down, it is slack at once. No cable pushes by it."""


@dataclass(frozen=True)
class Tensions(InputSignal):
    """Tension of each cable, (rows, n_cables) [N], none negative but LET_GO: a cable that no motor holds."""

    kind: ClassVar[InputKind] = InputKind.CABLES
    allowed: ClassVar[str] = "finite, >= 0 N"

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.n_inputs != len(SIDES):
            wanted = f"({self.times.size}, {len(SIDES)}): two cables in each row"
            raise InvalidValueError("shape of the tensions", self.values.shape, wanted)
        wrong = self.values[(self.values < 0) & (self.values != LET_GO)]
        if wrong.size:
            raise InvalidValueError("tension", float(wrong[0]), self.allowed)


def slack() -> Tensions:
    """No tension at any time, and no motor that holds a cable."""
    return Tensions(np.zeros(1), np.full((1, len(SIDES)), LET_GO))

"""Tensions of the cables at the base over time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.model import InputKind
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.errors import InvalidValueError

LET_GO = -1e-3
"""Value [N] for a released cable: no motor lowers its tension, it is slack at once. It does not make a cable push."""


@dataclass(frozen=True)
class Tensions(InputSignal):
    """Tension of each cable, (rows, n_cables) [N], none negative except LET_GO for a cable that no motor holds."""

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
    """Return slack cables at all times, held by no motor."""
    return Tensions(np.zeros(1), np.full((1, len(SIDES)), LET_GO))

"""Tensions of the cables over time: what pulls at the base."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.simulation_input import finite_array, output_times
from continuum.errors import InvalidValueError


@dataclass(frozen=True)
class Tensions:
    """Linear between its rows, held before the first and after the last.

    Attributes:
        times: of the rows, increasing, (rows,) [s].
        values: tension of each cable, (rows, n_cables) [N], none negative.
    """

    times: Array
    values: Array

    def __post_init__(self) -> None:
        times = output_times(self.times)
        values = finite_array("tensions", self.values, "finite, >= 0 N")
        if values.shape != (times.size, 2):
            raise InvalidValueError("shape of the tensions", values.shape, f"({times.size}, 2): two cables in each row")
        if np.any(values < 0):
            raise InvalidValueError("tension", float(values[values < 0][0]), "finite, >= 0 N")
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "values", values)

    def at(self, t: float) -> Array:
        """Tension of each cable at one time, (n_cables,) [N]."""
        return np.array([np.interp(t, self.times, column) for column in self.values.T])


def slack() -> Tensions:
    """No tension at any time."""
    return Tensions(np.zeros(1), np.zeros((1, 2)))

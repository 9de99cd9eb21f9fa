"""Tensions of the cables over time: what pulls at the base."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.simulation_input import finite_array, output_times
from continuum.errors import InvalidValueError

LET_GO = -1e-3
"""Tension [N] that says that a cable is let go: no motor lets it down, it is slack at once. No cable pushes by it."""


@dataclass(frozen=True)
class Tensions:
    """Linear between its rows, or each row held until the next; held before the first and after the last in any case.

    Attributes:
        times: of the rows, increasing, (rows,) [s].
        values: tension of each cable, (rows, n_cables) [N], none negative but LET_GO: a cable that no motor holds.
        held: a row holds until the next one, as a command does; else tensions change linearly, as measured ones.
    """

    times: Array
    values: Array
    held: bool = False

    def __post_init__(self) -> None:
        times = output_times(self.times)
        values = finite_array("tensions", self.values, "finite, >= 0 N")
        if values.shape != (times.size, 2):
            raise InvalidValueError("shape of the tensions", values.shape, f"({times.size}, 2): two cables in each row")
        wrong = values[(values < 0) & (values != LET_GO)]
        if wrong.size:
            raise InvalidValueError("tension", float(wrong[0]), "finite, >= 0 N")
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "values", values)

    def at(self, t: float) -> Array:
        """Tension of each cable at one time, (n_cables,) [N]."""
        if self.held:
            return np.asarray(self.values[max(int(np.searchsorted(self.times, t, side="right")) - 1, 0)])
        return np.array([np.interp(t, self.times, column) for column in self.values.T])

    def over(self, times: Array) -> Array:
        """Tension of each cable at several times, (n_times, n_cables) [N]."""
        return np.array([self.at(float(t)) for t in times])

    def later(self, delay: float) -> Tensions:
        """The same, by ``delay`` [s] later."""
        return replace(self, times=self.times + delay) if delay else self

    def rows(self) -> tuple[Array, Array]:
        """Times (rows,) and values (rows, n_cables), linear in between; two rows of one time are a jump."""
        if not self.held:
            return self.times, self.values
        return np.repeat(self.times, 2)[1:], np.repeat(self.values, 2, axis=0)[:-1]


def slack() -> Tensions:
    """No tension at any time, and no motor that holds a cable."""
    return Tensions(np.zeros(1), np.full((1, 2), LET_GO))

"""Inputs that drive an arm over time: rows of values, linear in between or held."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.model import InputKind
from continuum.dynamics.simulation_input import finite_array, output_times
from continuum.errors import InvalidValueError


@dataclass(frozen=True)
class InputSignal:
    """Inputs that are linear between rows or held until the next row, and constant before the first and after the last.

    Attributes:
        times: times of the rows, increasing, (rows,) [s].
        values: inputs, (rows, n_inputs).
        held: whether a row holds until the next one, as a command does; otherwise inputs change linearly, as measured
            ones do.

    Class attributes:
        kind: kind of the inputs.
        allowed: allowed values, in words.
    """

    times: Array
    values: Array
    held: bool = False

    kind: ClassVar[InputKind]
    allowed: ClassVar[str]

    def __post_init__(self) -> None:
        times = output_times(self.times)
        values = finite_array(self.kind.in_words, self.values, self.allowed)
        if values.ndim != 2 or len(values) != times.size:
            wanted = f"({times.size}, n_inputs), a row for each of the {times.size} times"
            raise InvalidValueError(f"shape of the {self.kind.in_words}", values.shape, wanted)
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "values", values)

    @property
    def n_inputs(self) -> int:
        """Number of inputs."""
        return int(self.values.shape[1])

    def at(self, t: float) -> Array:
        """Inputs at one time, (n_inputs,)."""
        if self.held:
            return np.asarray(self.values[max(int(np.searchsorted(self.times, t, side="right")) - 1, 0)])
        return np.array([np.interp(t, self.times, column) for column in self.values.T])

    def over(self, times: Array) -> Array:
        """Inputs at several times, (n_times, n_inputs)."""
        return np.array([self.at(float(t)) for t in times])

    def later(self, delay: float) -> Self:
        """Return the signal delayed by ``delay`` [s]."""
        return replace(self, times=self.times + delay) if delay else self

    def rows(self) -> tuple[Array, Array]:
        """Times (rows,) and values (rows, n_inputs), linear in between; two rows with equal times are a jump."""
        if not self.held:
            return self.times, self.values
        return np.repeat(self.times, 2)[1:], np.repeat(self.values, 2, axis=0)[:-1]

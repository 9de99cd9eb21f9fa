"""Segments of recordings: where they are cut, and the results of their simulation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from continuum.arrays import Array

_SHORT = 0.25  # fraction of a segment's length up to which a remainder makes no further segment


@dataclass(frozen=True)
class Segment:
    """A simulated stretch of a recording.

    Attributes:
        run, rows: number of the run, and rows in it.
        readings: angles as the sensors would read them, (rows, n) [rad]; NaN where the simulation failed.
        jacobian: derivatives J of the residuals of all rows and joints with respect to the unknowns: common to all
            recordings, of the run, and of the segment (initial angles, initial rates, zeros of the sensors),
            (rows n, k).
        residuals: r, (rows n,) [rad].
        information: J'J, (k, k).
    """

    run: int
    rows: slice
    readings: Array
    jacobian: Array
    residuals: Array
    information: Array

    @classmethod
    def of(cls, run: int, rows: slice, readings: Array, jacobian: Array, residuals: Array) -> Segment:
        """Return a segment with its information."""
        return cls(run, rows, readings, jacobian, residuals, jacobian.T @ jacobian)

    def with_residuals(self, residuals: Array) -> Segment:
        """Return the same with other residuals, (rows n,) [rad]."""
        return replace(self, residuals=residuals)

    def with_unknowns(self, which: Sequence[int]) -> Segment:
        """Return the same with derivatives by only some of the unknowns."""
        information = self.information[np.ix_(which, which)]
        return replace(self, jacobian=self.jacobian[:, which], information=information)

    def residuals_at(self, step: Array) -> Array:
        """Return the linearised residuals after a step of the unknowns (k,), (rows n,) [rad]."""
        return self.residuals + self.jacobian @ step

    @cached_property
    def product(self) -> float:
        """Sum of products of residuals one row apart [rad^2]."""
        r = self.residuals.reshape(self.readings.shape)
        return float(np.sum(r[1:] * r[:-1]))

    @cached_property
    def square(self) -> float:
        """Sum of the squared residuals [rad^2]."""
        return float(self.residuals @ self.residuals)

    @property
    def error(self) -> float:
        """Root mean square of the residuals [rad]."""
        return float(np.sqrt(self.square / self.readings.size))


def cut(times: Array, length: float) -> list[slice]:
    """Return the rows of segments of about the given length [s], with two rows or more each."""
    count = max(1, int(np.ceil((times[-1] - times[0]) / length - _SHORT)))
    edges = [0]
    for edge in np.searchsorted(times, np.linspace(times[0], times[-1], count + 1)[1:-1]):
        if edge - edges[-1] > 1 and len(times) - edge > 1:
            edges.append(int(edge))
    return [slice(a, b) for a, b in pairwise([*edges, len(times)])]

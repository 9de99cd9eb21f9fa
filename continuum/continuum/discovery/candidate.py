"""A set of effects at its optimum, with what the decision needs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array

type Key = tuple[tuple[str, tuple[int, ...] | None], ...]
"""Effects of a set and the joints at which each acts, from 0; None for an effect on the whole arm."""


_EXACT = 1e-12  # rad: least error, so that its logarithm is finite


def mean_error(errors: Array) -> Array:
    """Return the geometric mean over the segments, the last axis [rad]; infinite where a simulation failed."""
    return np.where(np.all(np.isfinite(errors), axis=-1), np.exp(np.mean(log_errors(errors), axis=-1)), np.inf)


def log_errors(errors: Array) -> Array:
    """Return the logarithms of errors; NaN where a simulation failed."""
    return np.log(np.maximum(errors, _EXACT))


@dataclass(frozen=True)
class Candidate:
    """A set of effects with the results of its fit.

    Attributes:
        effects: the set; empty for the refitted baseline.
        errors: root mean square errors of open-loop simulations by segment, (segments,) [rad]; NaN where one failed.
        observations: number of independent residuals.
        occam: cost of the per-run values, as `Fitted.occam`.
        values: values that its effects change; a set whose effects change a proper subset of them is nested in it.
        departure: minus the log prior density of the common values, up to a constant.
        zeros: p-value of the sensors' zeros that were set by hand, if the set is right.
        agreement: p-value of the segments' disagreement about the effects' sizes, if these are constant.
    """

    effects: Key
    errors: Array
    observations: float
    occam: float = 0.0
    values: frozenset[object] = frozenset()
    agreement: float = 1.0
    departure: float = 0.0
    zeros: float = 1.0

    @property
    def completed(self) -> bool:
        """Whether it can be simulated."""
        return bool(np.all(np.isfinite(self.errors)))

    @property
    def error(self) -> float:
        """Geometric mean over the segments [rad]; infinite where a simulation failed."""
        return float(mean_error(self.errors))

"""A set of effects at its own optimum, with all that a decision needs to know of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array

type Key = tuple[tuple[str, tuple[int, ...] | None], ...]
"""Effects of a set and the joints at which each acts, from 0; None where it belongs to the whole arm."""


_EXACT = 1e-12  # rad: an error is no less, so that it has a logarithm


def mean_error(errors: Array) -> Array:
    """Geometric mean over the segments, the last axis [rad]; infinite where a simulation failed."""
    return np.where(np.all(np.isfinite(errors), axis=-1), np.exp(np.mean(log_errors(errors), axis=-1)), np.inf)


def log_errors(errors: Array) -> Array:
    """Logarithms; NaN where a simulation failed."""
    return np.log(np.maximum(errors, _EXACT))


@dataclass(frozen=True)
class Candidate:
    """A set of effects.

    Attributes:
        effects: of the set; empty for the refitted baseline.
        errors: of open-loop simulations, root mean square by segment, (segments,) [rad]; NaN where one failed.
        observations: residuals that are independent of each other, their number.
        occam: what values that each recording has for itself cost, as `Fitted.occam`.
        values: what its effects change; another's whose effects change less of these is nested in it.
        departure: minus the logarithm of the prior density of the common values, less a constant.
        zeros: probability that zeros which were set by hand are as far from the set's, where it is right.
        agreement: probability that segments disagree as much about the effects' sizes, where these are constant.
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

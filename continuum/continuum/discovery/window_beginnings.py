"""First states of windows passed on from trial to trial: where one found a way to explain a window, others look too.

Where a joint is about to stick or to slip, a window may sit in a place from which slopes do not lead away. Which trial
sits there is luck, and luck is no evidence for an effect.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.trial import Trial

_BAD = 1.5  # misfit beside that of noise
_BETTER = 0.5  # of it


def with_beginnings_of(trial: Trial, others: Sequence[Trial]) -> Trial:
    """The trial as a start, its badly explained windows begun as by the one that explains them best, if far better."""
    mine = trial.relative
    theirs = np.array([other.relative for other in (trial, *others)])
    best = np.argmin(theirs, axis=0)
    takes = (mine > _BAD) & (theirs.min(axis=0) < _BETTER * mine)
    own = tuple(
        begun_as(others[best[window] - 1].own[window], here) if takes[window] else here
        for window, here in enumerate(trial.own)
    )
    return replace(trial, own=own)


def begun_as(there: Array, here: Array) -> Array:
    """Angles and rates from there, and as many states as there are, be they another effect's: it is but a beginning."""
    return np.concatenate([there[: here.size], here[there.size :]])

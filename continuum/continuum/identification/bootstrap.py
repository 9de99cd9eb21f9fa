"""Intervals that hold when errors are correlated in time: stretches of every run are drawn again (Kuensch 1989).

Each draw weighs stretches of the runs anew and moves the estimate by one step of Newton's method; no run is simulated
again. A stretch is a few windows long.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.identification.arrow_least_squares import reduced, weight_of
from continuum.identification.fit import Fit

_DRAWS = 2000
_WINDOWS = 4  # in a stretch


def bootstrap(fitted: Fit, random: np.random.Generator) -> Array:
    """Draws of the shared unknowns in their own units, what is added to their origin, (draws, k).

    Args:
        fitted: a fit.
        random: where the draws come from.
    """
    scores = stretch_scores(fitted)
    stretches = scores.shape[0]
    centred = (scores - scores.mean(axis=0)) * np.sqrt(stretches / max(stretches - 1, 1))
    counts = random.multinomial(stretches, np.full(stretches, 1 / stretches), size=_DRAWS) - 1.0
    moved = fitted.coordinates - np.linalg.solve(fitted.information, (counts @ centred).T).T
    return np.asarray(fitted.space.scale * moved)


def interval(draws: Array, level: float = 0.95) -> Array:
    """Lower and upper end for each unknown, (2, k)."""
    return np.quantile(draws, [(1 - level) / 2, (1 + level) / 2], axis=0)


def stretch_scores(fitted: Fit) -> Array:
    """Slope of the cost by the shared unknowns, stretch by stretch, (stretches, k)."""
    found, at = [], 0
    for run in fitted.runs:
        parts = fitted.parts[at : at + len(run.rows)]
        at += len(run.rows)
        scores = [weight_of(p) * reduced(p, fitted.unknowns.own_spread).T @ p.errors for p in parts]
        found += [sum(scores[i : i + _WINDOWS]) for i in range(0, len(scores), _WINDOWS)]
    return np.array(found)

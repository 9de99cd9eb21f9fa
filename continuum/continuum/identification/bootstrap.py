"""Intervals that hold when errors are correlated in time: stretches of every run are drawn again (Kuensch 1989).

Each draw weighs stretches of the runs anew and moves the estimate by one step of Newton's method; no run is simulated
again. A stretch is a few windows long. The fit has bent itself to each stretch, so that what is left there is too
small; a stretch counts by how far the fit would move without it (CR3, Bell and McCaffrey 2002). Few stretches may still
agree by chance, hence no interval is narrower than that of independent errors.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.identification.arrow_least_squares import reduced, weight_of
from continuum.identification.fit import Fit

_DRAWS = 2000
_WINDOWS = 4  # in a stretch
_STILL = 1e-6  # of the deviation that independent errors have


def bootstrap(fitted: Fit, random: np.random.Generator) -> Array:
    """Draws of the shared unknowns in their own units, what is added to their origin, (draws, k), within their bounds.

    Args:
        fitted: a fit.
        random: where the draws come from.
    """
    moves = moves_without(fitted)
    stretches = moves.shape[0]
    centred = (moves - moves.mean(axis=0)) * np.sqrt(stretches / max(stretches - 1, 1))
    counts = random.multinomial(stretches, np.full(stretches, 1 / stretches), size=_DRAWS) - 1.0
    away = -counts @ centred
    least = np.sqrt(np.diag(np.linalg.inv(fitted.information)))
    still = np.std(away, axis=0) < _STILL * least  # one stretch alone, or what the data say nothing of
    away[:, still] = random.normal(size=(_DRAWS, int(still.sum()))) * least[still]
    away *= np.maximum(1.0, least / np.std(away, axis=0))
    return np.asarray(fitted.space.scale * fitted.space.clipped(fitted.coordinates + away))


def interval(draws: Array, level: float = 0.95) -> Array:
    """Lower and upper end for each unknown, (2, k)."""
    return np.quantile(draws, [(1 - level) / 2, (1 + level) / 2], axis=0)


def moves_without(fitted: Fit) -> Array:
    """How the shared coordinates move when a stretch is left out, (stretches, k): (H - H_i)^-1 g_i."""
    found, at = [], 0
    for run in fitted.runs:
        parts = fitted.parts[at : at + len(run.rows)]
        spreads = fitted.unknowns.own_spread[at : at + len(run.rows)]
        at += len(run.rows)
        slopes = [reduced(part, spread) for part, spread in zip(parts, spreads, strict=True)]
        weights = [weight_of(part) for part in parts]
        for first in range(0, len(parts), _WINDOWS):
            mine = range(first, min(first + _WINDOWS, len(parts)))
            square = sum(weights[i] * slopes[i].T @ slopes[i] for i in mine)
            pull = sum(weights[i] * slopes[i].T @ parts[i].errors for i in mine)
            found.append(np.linalg.solve(fitted.information - square, pull))
    return np.array(found)

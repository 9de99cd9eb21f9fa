"""Intervals that hold when errors are correlated in time: blocks of every run are drawn again (Kuensch 1989).

Each draw weighs blocks of the runs' errors anew and moves the estimate by one step of Newton's method; no run is
simulated again. Blocks are as long as errors stay alike.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.identification.arrow_least_squares import RunPart
from continuum.identification.fit import Fit

_DRAWS = 2000
_BLOCKS_PER_RUN = 8


def bootstrap(fitted: Fit, random: np.random.Generator) -> Array:
    """Draws of the shared unknowns in their own units, what is added to their origin, (draws, k).

    Args:
        fitted: a fit.
        random: where the draws come from.
    """
    scores = np.concatenate([_block_scores(part, spread) for part, spread in zip(*_runs(fitted), strict=True)])
    centred = scores - scores.mean(axis=0)
    # few blocks make too small a spread: the usual factor, and Student's heavier tails through the draws' own variance
    blocks = centred.shape[0]
    counts = random.multinomial(blocks, np.full(blocks, 1 / blocks), size=_DRAWS) - 1.0
    steps = counts @ centred * np.sqrt(blocks / max(blocks - 1, 1))
    moved = fitted.coordinates + np.linalg.solve(fitted.information, -steps.T).T
    return np.asarray(fitted.runs[0].shared.scale * moved)


def interval(draws: Array, level: float = 0.95) -> Array:
    """Lower and upper end for each unknown, (2, k)."""
    return np.quantile(draws, [(1 - level) / 2, (1 + level) / 2], axis=0)


def _runs(fitted: Fit) -> tuple[list[RunPart], list[Array]]:
    return list(fitted.parts), list(fitted.unknowns.own_spread)


def _block_scores(part: RunPart, own_spread: Array) -> Array:
    """Slope of the cost by the shared unknowns, block by block, the run's own unknowns eliminated, (blocks, k)."""
    own = part.by_own.T @ part.by_own + np.diag(own_spread**-2.0)
    shared = part.by_shared - part.by_own @ np.linalg.solve(own, part.by_own.T @ part.by_shared)
    # errors are stored by channel kind and time, so that equal parts of the flat array are stretches of time
    pieces = np.array_split(np.arange(part.errors.size), 2 * _BLOCKS_PER_RUN)
    halves = np.stack([shared[rows].T @ part.errors[rows] for rows in pieces])
    return halves[:_BLOCKS_PER_RUN] + halves[_BLOCKS_PER_RUN:] if _has_rates(part) else halves


def _has_rates(part: RunPart) -> bool:
    return part.errors.size % 2 == 0

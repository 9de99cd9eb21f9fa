"""A fit from several starts, spread evenly over the prior: the best of short fits goes on to the end.

The model's own values are one start; the others are a Latin hypercube (McKay, Beckman and Conover 1979) of the prior's
quantiles, within the bounds. One start does where the cost has one valley (docs/identification.md); several tell.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import norm, qmc

from continuum.arrays import Array
from continuum.dynamics.simulator import Simulator
from continuum.errors import InvalidValueError
from continuum.identification.fit import Fit, fit
from continuum.identification.free import Free, FreeSpace
from continuum.identification.noise import Noise
from continuum.recordings.recording import Recording

_OUTERMOST = 0.01  # quantiles: no start is farther out


@dataclass(frozen=True)
class SeveralStarts:
    """The best fit, and what the starts say of each other.

    Attributes:
        best: fitted to the end.
        starts: coordinates, the model's own values first, (n_starts, k).
        costs: of the short fits from them, (n_starts,); infinite where no simulation was possible.
    """

    best: Fit
    starts: Array
    costs: Array


def fit_from_several(
    simulator: Simulator,
    recordings: Sequence[Recording],
    noise: Noise,
    free: Sequence[Free],
    random: np.random.Generator,
    starts: int = 5,
    iterations: int = 30,
    short: int = 6,
) -> SeveralStarts:
    """Fit the unknowns ``free`` from several starts.

    Args:
        simulator, recordings, noise, free, iterations: as of `continuum.identification.fit.fit`.
        random: draws the starts.
        starts: how many, the model's own values among them.
        short: iterations from each.

    Raises:
        InvalidValueError: no start, or an unknown that the model does not have.
    """
    if starts < 1:
        raise InvalidValueError("starts", starts, "1 or more")
    begun = spread_starts(FreeSpace(simulator.model, free), starts, random)
    fits = [fit(simulator, recordings, noise, free, start, iterations=short) for start in begun]
    costs = np.array([one.cost for one in fits])
    best = fits[int(np.argmin(costs))]
    ended = fit(simulator, recordings, noise, free, best.coordinates, iterations=iterations, own=best.unknowns.own)
    return SeveralStarts(ended, begun, costs)


def spread_starts(space: FreeSpace, starts: int, random: np.random.Generator) -> Array:
    """Coordinates (n_starts, k): zero, and quantiles of the prior, of every unknown each once."""
    k = space.spread.size
    if starts == 1 or k == 0:
        return np.zeros((1, k))
    even = qmc.LatinHypercube(k, rng=random).random(starts - 1)
    drawn = space.spread * norm.ppf(np.clip(even, _OUTERMOST, 1 - _OUTERMOST))
    return np.vstack([np.zeros(k), np.clip(drawn, space.lower, space.upper)])

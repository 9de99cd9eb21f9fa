"""How well the error of one run is known: Eq. 19 by stretches of the run that are drawn again (Kuensch 1989).

Errors of a free run hang together over much of a swing; stretches are an eighth of the run. What is measured, and its
standard deviation, is taken as it is.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array

_STRETCHES = 8
_DRAWS = 1000


def nrmse_interval(simulated: Array, measured: Array, random: np.random.Generator) -> tuple[float, float]:
    """The 95 % interval of Eq. 19; joints that never move do not count.

    Args:
        simulated, measured: (n_times, n_joints), of one unit.
        random: where the draws come from.
    """
    spread = np.std(measured, axis=0)
    moving = spread > 0
    squares = ((simulated - measured)[:, moving] / spread[moving]) ** 2
    pieces = [piece for piece in np.array_split(squares, _STRETCHES) if piece.size]
    sums, sizes = np.array([piece.sum(axis=0) for piece in pieces]), np.array([len(piece) for piece in pieces])
    counts = random.multinomial(len(pieces), np.full(len(pieces), 1 / len(pieces)), size=_DRAWS)
    drawn = np.sqrt((counts @ sums) / (counts @ sizes)[:, None]).mean(axis=1)
    low, high = np.quantile(drawn, [0.025, 0.975])
    return float(low), float(high)

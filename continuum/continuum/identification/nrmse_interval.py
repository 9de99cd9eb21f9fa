"""How well the error of one run is known: Eq. 19 without each stretch of the run (jackknife, Tukey 1958; Kuensch 1989).

Errors of a free run hang together over much of a swing; stretches are an eighth of the run. What is measured, and its
standard deviation, is taken as it is. The interval is one of the logarithm: an error is never negative, and few
stretches often lack the worst that could happen. Of errors that hang together over half a stretch it holds 88 % instead
of 95 %, over a whole one fewer.
"""

from __future__ import annotations

import numpy as np
from scipy.stats import t

from continuum.arrays import Array

_STRETCHES = 8


def nrmse_interval(simulated: Array, measured: Array) -> tuple[float, float]:
    """The 95 % interval of Eq. 19; joints that never move do not count, and NaN where none does.

    Args:
        simulated, measured: (n_times, n_joints), of one unit.
    """
    spread = np.std(measured, axis=0)
    moving = spread > 0
    pieces = np.array_split(((simulated - measured)[:, moving] / spread[moving]) ** 2, _STRETCHES)
    pieces = [piece for piece in pieces if piece.size]
    if len(pieces) < 2:
        return np.nan, np.nan
    sums, sizes = np.array([piece.sum(axis=0) for piece in pieces]), np.array([len(piece) for piece in pieces])
    error = float(np.sqrt(sums.sum(axis=0) / sizes.sum()).mean())
    if error == 0.0:
        return 0.0, 0.0
    without = np.sqrt((sums.sum(axis=0) - sums) / (sizes.sum() - sizes)[:, None]).mean(axis=1)
    m = len(pieces)
    deviation = np.sqrt((m - 1) / m * np.sum((without - without.mean()) ** 2)) / error
    factor = float(np.exp(t.ppf(0.975, m - 1) * deviation))
    return error / factor, error * factor

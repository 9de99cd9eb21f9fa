"""Derivatives of measured signals by local polynomial fits (Savitzky and Golay 1964)."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array

_HALF = 3  # samples to each side


def local_derivative(times: Array, signals: Array, row: int, degree: int) -> Array:
    """Return the derivative at one sample; times may be uneven.

    Args:
        times: (n_times,) [s].
        signals: (n_times, n).
        row: row of the sample; near an end, the fit takes the samples nearest to it.
        degree: degree of the polynomial, reduced if there are too few samples.

    Returns:
        (n,), in the signals' unit per second.
    """
    first = max(0, min(row - _HALF, times.size - 2 * _HALF - 1))
    rows = slice(first, first + 2 * _HALF + 1)
    t = times[rows] - times[row]
    return np.asarray(np.polynomial.polynomial.polyfit(t, signals[rows], min(degree, t.size - 1))[1])

"""Even functions of an angle that stay exact at zero, where their usual quotients are 0/0.

The straight posture is an ordinary input everywhere because section and cable maps are written with these.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial import polynomial

from continuum.arrays import Array

# Taylor coefficients in x^2, used below `_SMALL`; the first term left out is below 1e-17 of the sum there.
_SMALL = 0.5
_SINC_SLOPE = (-1 / 3, 1 / 30, -1 / 840, 1 / 45360, -1 / 3991680, 1 / 518918400, -1 / 93405312000)
_ONE_MINUS_SINC = (1 / 6, -1 / 120, 1 / 5040, -1 / 362880, 1 / 39916800, -1 / 6227020800, 1 / 1307674368000)


def sinc(x: Array) -> Array:
    """sin(x) / x, with x in rad (unlike :func:`numpy.sinc`)."""
    return np.sinc(x / np.pi)


def versine(x: Array) -> Array:
    """(1 - cos x) / x^2."""
    return 0.5 * sinc(0.5 * x) ** 2


def sinc_slope(x: Array) -> Array:
    """sinc'(x) / x = (x cos x - sin x) / x^3."""
    return _series_near_zero(x, _SINC_SLOPE, lambda y: (y * np.cos(y) - np.sin(y)) / y**3)


def one_minus_sinc(x: Array) -> Array:
    """(1 - sinc x) / x^2 = (x - sin x) / x^3."""
    return _series_near_zero(x, _ONE_MINUS_SINC, lambda y: (y - np.sin(y)) / y**3)


def _series_near_zero(x: Array, coefficients: tuple[float, ...], quotient: Callable[[Array], Array]) -> Array:
    x = np.asarray(x, dtype=float)
    small = np.abs(x) < _SMALL
    away = np.where(small, 1.0, x)
    return np.where(small, polynomial.polyval(x * x, coefficients), quotient(away))

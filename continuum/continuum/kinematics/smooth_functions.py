"""Even functions of an angle that are exact at zero, where their usual quotients are 0/0.

Section and cable maps use them, so that the straight posture needs no special case. They accept arrays and floats and
have no branches, so that the compiled solver can use them unchanged.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np

from continuum.arrays import Array

Real = TypeVar("Real", float, Array)

_SMALL = 0.5  # below it a series is used; its first omitted term is below 1e-17 of the sum


def sinc(x: Real) -> Real:
    """sin(x) / x, with x in rad (unlike :func:`numpy.sinc`)."""
    zero = x == 0.0
    quotient: Real = np.sin(x) / (x + zero) + zero
    return quotient


def versine(x: Real) -> Real:
    """(1 - cos x) / x^2."""
    half = sinc(0.5 * x)
    return 0.5 * half * half


def sinc_derivative(x: Real) -> Real:
    """sinc'(x) / x = (x cos x - sin x) / x^3."""
    small = np.abs(x) < _SMALL
    y = x * x * small
    series = -1 / 3 + y * (
        1 / 30 + y * (-1 / 840 + y * (1 / 45360 + y * (-1 / 3991680 + y * (1 / 518918400 - y / 93405312000))))
    )
    away = x * (1 - small) + small
    result: Real = small * series + (1 - small) * (away * np.cos(away) - np.sin(away)) / (away * away * away)
    return result


def one_minus_sinc(x: Real) -> Real:
    """(1 - sinc x) / x^2 = (x - sin x) / x^3."""
    small = np.abs(x) < _SMALL
    y = x * x * small
    series = 1 / 6 + y * (
        -1 / 120 + y * (1 / 5040 + y * (-1 / 362880 + y * (1 / 39916800 + y * (-1 / 6227020800 + y / 1307674368000))))
    )
    away = x * (1 - small) + small
    result: Real = small * series + (1 - small) * (away - np.sin(away)) / (away * away * away)
    return result

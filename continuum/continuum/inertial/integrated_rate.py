"""How far a link turned since its sensor was last heard, and how wrong that may be."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array

_SAFETY = 1.5


def turn_since(rate: Array, rate_before: Array, elapsed: Array, period: float, means: bool) -> Array:
    """Turn over ``elapsed`` [rad], (n,).

    Sensors that sum up inside give the mean over the last period, which times the period is exact; rates at instants
    are taken as linear in between, as is what was not heard.

    Args:
        rate, rate_before: about the axis now and when last heard, (n,) [rad/s].
        elapsed: since then, (n,) [s].
        period: between samples [s].
        means: whether rates are means over the period before their time.
    """
    known = np.minimum(elapsed, period) if means else np.zeros_like(elapsed)
    return np.asarray(rate * known + (rate_before + rate) / 2 * (elapsed - known))


def error_of_gap(missing: Array, curvature: Array) -> Array:
    """Error of the turn over readings that were not heard or clipped, (n,) [rad].

    With linear interpolation over m missing readings it grows as m (m + 1)^2 times the rate's second derivative.

    Args:
        missing: how many, (n,).
        curvature: largest error, lately, of interpolating one reading that was heard, (n,) [rad].
    """
    return np.asarray(_SAFETY * curvature * missing * (missing + 1) ** 2 / 4)


def curvature(rates: Array, period: float) -> Array:
    """Error that interpolating the middle one of three rates (3, n) would make of its turn, (n,) [rad]."""
    return np.asarray(np.abs(rates[1] - (rates[0] + rates[2]) / 2) * period)

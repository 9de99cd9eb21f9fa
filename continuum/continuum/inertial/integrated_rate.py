"""How far a link turned since its first reading or the one before, and how wrong that may be."""

from __future__ import annotations

from dataclasses import dataclass

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


def integrated(times: Array, rates: Array) -> Array:
    """Angles since the first time, (n_times, n) [rad]; the rates (n_times, n) [rad/s] are linear between the times."""
    steps = (rates[1:] + rates[:-1]) / 2 * np.diff(times)[:, None]
    return np.concatenate([np.zeros((1, rates.shape[1])), np.cumsum(steps, axis=0)])


@dataclass(frozen=True)
class Liveliness:
    """How much the rates changed lately, from which is reckoned what may have happened while nothing was heard.

    Attributes:
        bend: largest error that linear interpolation of a reading between its neighbours would have made of the turn,
            (n,) [rad].
        step: largest change from one reading to the next, (n,) [rad/s].
    """

    bend: Array
    step: Array

    def after(self, rates: Array, period: float, remembered: float) -> Liveliness:
        """With the newest three readings (3, n) [rad/s], older ones counting less from ``remembered`` [s] on."""
        fade = np.exp(-period / remembered)
        bend = np.abs(rates[1] - (rates[0] + rates[2]) / 2) * period
        step = np.abs(rates[2] - rates[1])
        return Liveliness(np.maximum(self.bend * fade, bend), np.maximum(self.step * fade, step))

    def error_of_gap(self, missing: Array, change: Array, period: float) -> Array:
        """Error of the turn over readings that were not heard and were taken as linear, (n,) [rad].

        It grows as m (m + 1)^2 with their number m and the second derivative of the rate. If the rate changed by more
        than it did lately in that time, the arm was let go or stopped within, at an instant that nobody knows.

        Args:
            missing: m, (n,).
            change: of the rate over the gap, (n,) [rad/s].
            period: between readings [s].
        """
        smooth = _SAFETY * self.bend * missing * (missing + 1) ** 2 / 4
        sudden = np.maximum(np.abs(change) - self.step * (missing + 1), 0.0) * missing * period / 2
        return np.asarray(smooth + sudden)

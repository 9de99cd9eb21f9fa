"""Turn of a link since its first reading or the one before, and the error of that."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array

_SAFETY = 1.5


def turn_since(rate: Array, rate_before: Array, elapsed: Array, period: float, means: bool) -> Array:
    """Return the turn over ``elapsed`` [rad], (n,).

    Sensors that integrate internally give the mean over the last period, and its product with the period is exact;
    instantaneous rates are interpolated linearly, as are missing readings.

    Args:
        rate, rate_before: rate about the axis, now and when last received, (n,) [rad/s].
        elapsed: time since then, (n,) [s].
        period: time between samples [s].
        means: whether rates are means over the period before their time.
    """
    known = np.minimum(elapsed, period) if means else np.zeros_like(elapsed)
    return np.asarray(rate * known + (rate_before + rate) / 2 * (elapsed - known))


def integrated(times: Array, rates: Array) -> Array:
    """Return angles since the first time, (n_times, n) [rad], from rates (n_times, n) [rad/s], linear between times."""
    steps = (rates[1:] + rates[:-1]) / 2 * np.diff(times)[:, None]
    return np.concatenate([np.zeros((1, rates.shape[1])), np.cumsum(steps, axis=0)])


@dataclass(frozen=True)
class Liveliness:
    """Recent changes of the rates, from which errors over missing readings are estimated.

    Attributes:
        bend: largest error of the turn if a reading is interpolated linearly between its neighbours, (n,) [rad].
        step: largest change from one reading to the next, (n,) [rad/s].
    """

    bend: Array
    step: Array

    def after(self, rates: Array, period: float, remembered: float) -> Liveliness:
        """Update with the last three readings (3, n) [rad/s]; older ones fade with time constant ``remembered`` [s]."""
        fade = np.exp(-period / remembered)
        bend = np.abs(rates[1] - (rates[0] + rates[2]) / 2) * period
        step = np.abs(rates[2] - rates[1])
        return Liveliness(np.maximum(self.bend * fade, bend), np.maximum(self.step * fade, step))

    def error_of_gap(self, missing: Array, change: Array, period: float) -> Array:
        """Return the error of the turn over missing readings that were interpolated linearly, (n,) [rad].

        It grows as m (m + 1)^2 with their number m and the second derivative of the rate. If the rate changed by more
        than it recently did in such a time, the arm was released or stopped in the gap, at an unknown instant.

        Args:
            missing: number m of missing readings, (n,).
            change: change of the rate over the gap, (n,) [rad/s].
            period: time between readings [s].
        """
        smooth = _SAFETY * self.bend * missing * (missing + 1) ** 2 / 4
        sudden = np.maximum(np.abs(change) - self.step * (missing + 1), 0.0) * missing * period / 2
        return np.asarray(smooth + sudden)

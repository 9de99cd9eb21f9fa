"""Angle and bias corrected by the accelerometer at rest: the slow half of a complementary filter.

The fast half is the integrated rate. While a sensor rests, with e the inclination minus the angle,

    alpha <- alpha + k e,   b <- b - e dt / (tau tau_b),   k = dt / tau,

which high-passes the drift of the integral and low-passes the inclination at 1 / tau, with an integral part that learns
the remaining bias. A link that has just come to rest with a lost angle first takes the mean of its inclinations
(k = 1, 1/2, 1/3 ..), so that its angle is known at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array

_LARGEST_DRIFT = np.radians(1.0)  # rad/s that the integral part may learn


@dataclass(frozen=True)
class Correction:
    """New values, (n,) each: angle [rad], remaining bias about the axis [rad/s], estimated error of the angle [rad]."""

    angle: Array
    drift: Array
    error: Array


@dataclass(frozen=True)
class ComplementaryFilter:
    """Time constants [s] of angle and bias, and the error of an inclination [rad]."""

    time_constant: float
    bias_time: float
    inclination_error: float

    def corrected(self, before: Correction, off: Array, elapsed: float, count: Array) -> Correction:
        """Take one step at sensors that rest; the others stay as they are.

        Args:
            before: values before the step.
            off: inclination minus angle, (n,) [rad].
            elapsed: time since the step before [s].
            count: number of corrections since the angle was lost, with this one; 0 at those that do not rest, (n,).
        """
        share, resting = min(elapsed / self.time_constant, 1.0), count > 0
        gain = np.where(resting, np.maximum(share, 1 / np.maximum(count, 1)), 0.0)
        learns = count * share > 1
        drift = before.drift - np.where(learns, off * share / self.bias_time, 0.0)
        error = before.error + share * (self.inclination_error - before.error)
        return Correction(
            before.angle + gain * off,
            np.clip(drift, -_LARGEST_DRIFT, _LARGEST_DRIFT),
            np.where(resting, error, before.error),
        )

"""Whether angles change by what their rates add up to: by r = 1 times that, where clock, units and gains are right.

  r = sum(I theta) / sum(I^2),  I the integral of a joint's rate, both less their mean and slope in time.

No model of the arm is asked: gyros that drift, sensors that are late and zeros that are off leave r as it is. A clock
that is slow by 5 % makes r = 0.95, gyros that show 20 % too much r = 0.83; what a noise estimate would take for sensors
that wander is then no noise, and all that is fitted is off.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.arrays import Array
from continuum.identification.recording import Recording

_ENOUGH = 0.03  # off 1; sampled rates of joints that stick and slip add up to a hundredth or two too little
_DEVIATIONS = 4.0
_QUIETED = 8  # rows, over which an angle's white noise is averaged


def odd_rates(recordings: Sequence[Recording]) -> list[str]:
    """A sentence where angles and rates are not of one motion; none where all is well."""
    ratio, deviation = rate_ratio(recordings)
    if abs(ratio - 1) <= max(_ENOUGH, _DEVIATIONS * deviation):
        return []
    why = "the clock, a unit or the gyros' gain is wrong, and what is fitted is off by it"
    return [f"angles change {ratio:.2f} times as much as their rates add up to: {why}"]


def rate_ratio(recordings: Sequence[Recording]) -> tuple[float, float]:
    """r of all joints and recordings with rates, and its standard deviation; 1 and infinite where there are none.

    What is left of an angle hangs together over a second or so: a joint's whole recording counts as one sample of it.
    """
    product = square = error = 0.0
    for run in recordings:
        if run.theta_rate is None:
            continue
        added, angle = (_swinging(run.times, each) for each in (added_up(run.times, run.theta_rate), run.theta))
        size, common = (added**2).sum(axis=0), (added * angle).sum(axis=0)
        left = angle - added * common / np.where(size > 0, size, 1.0)
        pieces = np.array_split(left, max(1, len(left) // _QUIETED))
        product, square = product + float(common.sum()), square + float(size.sum())
        error += float(size @ sum(len(piece) * piece.mean(axis=0) ** 2 for piece in pieces))
    return (product / square, float(np.sqrt(error)) / square) if square > 0 else (1.0, float("inf"))


def added_up(times: Array, rate: Array) -> Array:
    """Integral of the rates from the first sample on, (n_times, n_joints) [rad]."""
    steps = (rate[1:] + rate[:-1]) / 2 * np.diff(times)[:, None]
    return np.concatenate([np.zeros((1, rate.shape[1])), np.cumsum(steps, axis=0)])


def _swinging(times: Array, signal: Array) -> Array:
    """Less its mean and its slope in time."""
    away = np.stack([np.ones(times.size), times - times.mean()], axis=1)
    return np.asarray(signal - away @ np.linalg.lstsq(away, signal)[0])

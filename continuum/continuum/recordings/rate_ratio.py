"""Whether angles change as the integrals of their rates: the ratio r is 1 if clock, units and gains are right.

  r = sum(I theta) / sum(I^2),  I the integral of a joint's rate, both minus their mean and linear trend in time

No model of the arm is needed: drifting gyros, a common delay of all sensors and wrong zeros leave r unchanged. A clock
that shows 5 % too little time makes r = 1.05, gyros that show 20 % too much make r = 0.83; a noise estimate would then
mistake the difference for wandering sensors, and all fitted values would be wrong.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import CubicSpline

from continuum.arrays import Array
from continuum.languages import Message
from continuum.recordings.recording import Recording

_ENOUGH = 0.03  # from 1, of all recordings or of one; correct ones with stick-slip deviate by up to 0.02
_ENOUGH_OF_A_JOINT = 0.15  # one that sticks all the time deviates by up to 0.08
_DEVIATIONS = 4.0
_QUIETED = 8  # rows over which an angle's white noise is averaged


def odd_rates(recordings: Sequence[Recording]) -> list[Message]:
    """Return a sentence if angles and rates are not of one motion, or one for each recording and joint; else none."""
    description = _described(rate_ratio(recordings), _ENOUGH)
    if description:
        return description
    runs = [(run.name, _described(rate_ratio([run]), _ENOUGH)) for run in recordings]
    joints = [
        (Message("joint {joint}", joint=joint + 1), _described(rate_ratio(recordings, joint), _ENOUGH_OF_A_JOINT))
        for joint in range(recordings[0].n_joints)
    ]
    return [Message("{where}: {what}", where=where, what=one) for where, found in (*runs, *joints) for one in found]


def _described(found: tuple[float, float], enough: float) -> list[Message]:
    ratio, deviation = found
    if abs(ratio - 1) <= max(enough, _DEVIATIONS * deviation):
        return []
    return [
        Message(
            "angles change by {ratio:.2f} times the integral of their rates: the clock, a unit or a gyro's gain is "
            "wrong, and so are fitted values",
            ratio=ratio,
        )
    ]


def rate_ratio(recordings: Sequence[Recording], joint: int | None = None) -> tuple[float, float]:
    """Return r of recordings with rates, of all joints or of one, and its standard deviation; 1 and infinity without.

    Rates jump between samples where a joint sticks or slips: the r of every second sample shows the effect.
    """
    found, deviation = _ratio(recordings, joint)
    halves = [_ratio([run.rows(slice(first, None, 2)) for run in recordings], joint)[0] for first in (0, 1)]
    return found, float(np.hypot(deviation, max(abs(half - found) for half in halves)))


def _ratio(recordings: Sequence[Recording], joint: int | None) -> tuple[float, float]:
    """Return r, and its standard deviation from the residuals of the angles.

    These are correlated over about a second: a joint's whole recording counts as one sample of them.
    """
    product = square = error = 0.0
    chosen = slice(None) if joint is None else slice(joint, joint + 1)
    for run in recordings:
        if run.theta_rate is None:
            continue
        integral = CubicSpline(run.times, run.theta_rate[:, chosen]).antiderivative()(run.times)
        added, angle = (_swinging(run.times, each) for each in (integral, run.theta[:, chosen]))
        size, common = (added**2).sum(axis=0), (added * angle).sum(axis=0)
        left = angle - added * common / np.where(size > 0, size, 1.0)
        pieces = np.array_split(left, max(1, len(left) // _QUIETED))
        product, square = product + float(common.sum()), square + float(size.sum())
        error += float(size @ sum(len(piece) * piece.mean(axis=0) ** 2 for piece in pieces))
    return (product / square, float(np.sqrt(error)) / square) if square > 0 else (1.0, float("inf"))


def _swinging(times: Array, signal: Array) -> Array:
    """Return a signal minus its mean and linear trend in time."""
    away = np.stack([np.ones(times.size), times - times.mean()], axis=1)
    return np.asarray(signal - away @ np.linalg.lstsq(away, signal)[0])

"""Whether angles change by what their rates add up to: by r = 1 times that, where clock, units and gains are right.

  r = sum(I theta) / sum(I^2),  I the integral of a joint's rate, both less their mean and slope in time

No model of the arm is asked: gyros that drift, sensors that are all late alike and zeros that are off leave r as it is.
A clock that shows 5 % too little time makes r = 1.05, gyros that show 20 % too much r = 0.83; what a noise estimate
would take for sensors that wander is then no noise, and all that is fitted is off.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import CubicSpline

from continuum.arrays import Array
from continuum.recordings.recording import Recording

_ENOUGH = 0.03  # off 1, of all recordings or of one; where joints stick and slip sound ones are off by up to 0.02
_ENOUGH_OF_A_JOINT = 0.15  # one that sticks all the time is off by up to 0.08
_DEVIATIONS = 4.0
_QUIETED = 8  # rows, over which an angle's white noise is averaged


def odd_rates(recordings: Sequence[Recording]) -> list[str]:
    """A sentence where angles and rates are not of one motion, or one for each recording and joint; none otherwise."""
    description = _described("", rate_ratio(recordings), _ENOUGH)
    if description:
        return description
    runs = [_described(f"{run.name}: ", rate_ratio([run]), _ENOUGH) for run in recordings]
    joints = [
        _described(f"joint {joint + 1}: ", rate_ratio(recordings, joint), _ENOUGH_OF_A_JOINT)
        for joint in range(recordings[0].n_joints)
    ]
    return [sentence for found in (*runs, *joints) for sentence in found]


def _described(where: str, found: tuple[float, float], enough: float) -> list[str]:
    ratio, deviation = found
    if abs(ratio - 1) <= max(enough, _DEVIATIONS * deviation):
        return []
    why = "the clock, a unit or a gyro's gain is wrong, and what is fitted is off by it"
    return [f"{where}angles change {ratio:.2f} times as much as their rates add up to: {why}"]


def rate_ratio(recordings: Sequence[Recording], joint: int | None = None) -> tuple[float, float]:
    """r of recordings with rates, of all joints or of one, and its standard deviation; 1 and infinite without any.

    Between samples rates jump where a joint sticks or slips: what every second sample would say tells by how much.
    """
    found, deviation = _ratio(recordings, joint)
    halves = [_ratio([run.rows(slice(first, None, 2)) for run in recordings], joint)[0] for first in (0, 1)]
    return found, float(np.hypot(deviation, max(abs(half - found) for half in halves)))


def _ratio(recordings: Sequence[Recording], joint: int | None) -> tuple[float, float]:
    """r, and its standard deviation by what is left of the angles.

    That hangs together over a second or so: a joint's whole recording counts as one sample of it.
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
    """Less its mean and its slope in time."""
    away = np.stack([np.ones(times.size), times - times.mean()], axis=1)
    return np.asarray(signal - away @ np.linalg.lstsq(away, signal)[0])

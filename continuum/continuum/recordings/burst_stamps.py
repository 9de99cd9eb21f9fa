"""Stamps of arrival: readings that were taken evenly, and handed over and stamped in bursts.

Stamps come in bursts if a third of the steps or more are shorter than half of the mean step; half of them are already
where pairs arrive. Pauses recur: single ones are gaps. The stamps are those of arrival if the angles change evenly from
row to row and not with the stamps. Each angle beside an uneven step is compared with the line through its two
neighbours, once over the stamps (weight w of the later one) and once over the numbers of the rows (w = 1/2):

    e = (theta_k - (1 - w) theta_k-1 - w theta_k+1) / sqrt(1 + w^2 + (1 - w)^2)

The divisor makes both errors equally large where angles hold white noise alone, as in slow motion; then no clock is the
likelier one, and the recording is kept. e(w)^2 - e(1/2)^2, relative to the variance, has a variance of at most 1, and
twice that in a sum, where neighbours share readings. Of n rows beside uneven steps, stamps are those of arrival if the
ratio of the sums of squares, averaged over the joints, is beyond 1 by more than z sqrt(2 / (n n_joints)).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.recordings.samples import Samples

_MANY, _SHORT = 1 / 3, 1 / 2
_LARGEST = 30  # readings of a burst
_UNEVEN = 3.0  # ratio of the steps before and after a row from which the two clocks differ by a quarter of a step
_BEYOND = float(norm.ppf(0.999))  # z; of few rows the ratio has a longer tail: up to 1 in 100 is refused, not 1 in 1000


def refuse_bursts(samples: Samples) -> None:
    """Refuse stamps of arrival.

    Raises:
        FileError: stamps come in bursts, and angles do not follow them.
    """
    steps = np.diff(samples.times)
    if steps.size < 2:
        return
    mean = float(samples.times[-1] - samples.times[0]) / steps.size
    short = steps < _SHORT * mean
    if not _MANY * steps.size <= np.count_nonzero(short) <= (1 - 1 / _LARGEST) * steps.size:
        return
    if not _follow_their_number(samples.theta, steps):
        return
    edges = np.flatnonzero(np.diff(np.concatenate([[False], short, [False]]).astype(int)))
    lengths = edges[1::2] - edges[::2] + 1
    within, between = np.median(steps[short]), steps[~short]
    low, high = (f"{1e3 * value:.3g}" for value in np.percentile(between, [5, 95]))
    pause = f"{low} ms" if low == high else f"{low} to {high} ms"
    raise FileError(
        samples.path,
        f"stamps come in bursts: {np.median(lengths):.0f} {samples.row}s {1e3 * within:.3g} ms apart, then none for "
        f"{pause}, while the angles change evenly from {samples.row} to {samples.row}: stamps of arrival? Number the "
        f"{samples.row}s and divide by the rate of the readings, {1 / mean:.4g} a second on average",
    )


def _follow_their_number(theta: Array, steps: Array) -> bool:
    """Whether angles change with the number of the row rather than with its stamp."""
    before, after = steps[:-1], steps[1:]
    weight = before / np.maximum(before + after, np.finfo(float).tiny)
    uneven = np.maximum(before, after) > _UNEVEN * np.minimum(before, after)
    continuous = np.unwrap(theta, axis=0)

    def error(w: Array) -> NDArray[np.float64]:
        line = (1 - w)[:, None] * continuous[:-2] + w[:, None] * continuous[2:]
        each = (continuous[1:-1] - line) ** 2 / (1 + w**2 + (1 - w) ** 2)[:, None]
        return np.asarray(each[uneven].sum(axis=0))

    rows = int(np.count_nonzero(uneven))
    if rows == 0:
        return False
    by_number, by_stamp = error(np.full(weight.shape, 0.5)), error(weight)
    tell = by_number + by_stamp > 0  # a joint that rests does not
    ratios = by_stamp[tell] / np.maximum(by_number[tell], np.finfo(float).tiny)
    return bool(np.sum(ratios - 1) > _BEYOND * np.sqrt(2 * ratios.size / rows))

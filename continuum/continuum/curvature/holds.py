"""Stretches of a recording in which no joint moves.

Angles are averaged over parts of a tenth of a second. In a hold, the averages of each joint are no further from the
middle than

    hypot(SETTLED, z sigma / sqrt(rows in a part)),    z = 3

SETTLED, from `continuum.inertial.stillness`, is what counts as the same posture; the other term is the effect of white
noise of standard deviation sigma, from `continuum.estimation.sensor_noise`. A hold lasts for SHORTEST_REST or longer,
and within a part the rows vary by no more than that. The longest stretch is taken first, so that no hold begins with
the end of a motion; a creeping posture is cut into several holds. If constant tensions end in a release, the rows
before it are a hold of any length.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.estimation.sensor_noise import recording_noise
from continuum.inertial.stillness import SETTLED, SHORTEST_REST
from continuum.recordings.recording import Recording

_PART = 0.1
"""Duration of a part [s]: a few rows of any usual sensor, and a small part of an arm's swing."""

_SIGMAS = 3.0


@dataclass(frozen=True)
class Hold:
    """One stretch without motion.

    Attributes:
        recording: recording that it is a part of.
        rows: rows of the recording.
        theta: median of each joint's angle, (n,) [rad].
        noise: covariance of a row's angles due to white noise, (n, n) [rad^2].
        tension: median of each cable's tension, (2,) [N]; None if no tensions were recorded.
        approach: direction of the last bending: 1 towards positive angles, -1 towards negative ones. Without a motion
            before the hold, the arm is assumed to have been bent from straight.
    """

    recording: Recording
    rows: slice
    theta: Array
    noise: Array
    tension: Array | None
    approach: int

    @property
    def times(self) -> Array:
        """Times of the rows [s]."""
        return self.recording.times[self.rows]

    @property
    def since_begin(self) -> float:
        """Time from the recording's first row to the middle of the hold [s]."""
        return float((self.times[0] + self.times[-1]) / 2 - self.recording.times[0])

    @property
    def angles(self) -> Array:
        """Angles of the rows, (n_rows, n) [rad]."""
        return self.recording.theta[self.rows]


def find_holds(recording: Recording) -> list[Hold]:
    """Find all holds of a recording, in the order of time."""
    parts = _Parts.of(recording)
    ends = np.append(parts.first, recording.times.size)
    found = [
        slice(int(ends[a]), int(ends[b]))
        for a, b in _longest_first(np.where(parts.still[:, None], parts.mean, np.nan), parts.limit)
    ]
    rows = [one for one in found if np.ptp(recording.times[one]) >= SHORTEST_REST - _PART]
    held = _before_release(recording)
    if held > 0 and not any(one.start < held for one in rows):
        rows.append(slice(0, held))
    return [_hold(recording, one, parts) for one in sorted(rows, key=lambda one: one.start)]


def hold_at(recording: Recording, rows: slice) -> Hold:
    """Return the hold of one or more rows in which the arm is known to have rested."""
    return _hold(recording, rows, _Parts.of(recording))


@dataclass(frozen=True)
class _Parts:
    """Parts of a recording.

    Attributes:
        first: first row of each, (n_parts,).
        mean: mean angles of each, (n_parts, n) [rad].
        noise: covariance of a row's angles due to white noise, (n, n) [rad^2].
        limit: range of the means of a hold, (n,) [rad].
        still: whether the rows of each vary by no more than white noise and SETTLED, (n_parts,): the means of a
            shaking arm stay constant.
    """

    first: NDArray[np.intp]
    mean: Array
    noise: Array
    limit: Array
    still: NDArray[np.bool_]

    @classmethod
    def of(cls, recording: Recording) -> _Parts:
        since = recording.times - recording.times[0]
        first = np.flatnonzero(np.diff(np.floor(since / _PART), prepend=-1.0))
        counts, noise = np.diff(np.append(first, since.size)), recording_noise(replace(recording, theta_rate=None))
        mean = np.add.reduceat(recording.theta, first, axis=0) / counts[:, None]
        by_noise = _SIGMAS * np.sqrt(np.diag(noise) / np.median(counts))
        about = np.add.reduceat((recording.theta - np.repeat(mean, counts, axis=0)) ** 2, first, axis=0)
        still = np.all(about / counts[:, None] <= SETTLED**2 + _SIGMAS**2 * np.diag(noise), axis=1)
        return cls(first, mean, noise, 2 * np.hypot(SETTLED, by_noise), still)


def _hold(recording: Recording, rows: slice, parts: _Parts) -> Hold:
    theta, tension = np.median(recording.theta[rows], axis=0), None
    if recording.tensions is not None:
        tension = np.maximum(np.median(recording.pull.over(recording.times[rows]), axis=0), 0.0)
    moved = theta.sum() - parts.mean[parts.first < rows.start].sum(axis=1)
    moved = moved[np.abs(moved) > np.linalg.norm(parts.limit)]
    last = float(moved[-1]) if moved.size else float(theta.sum())
    return Hold(recording, rows, theta, parts.noise, tension, 1 if last > 0 else -1)


def _before_release(recording: Recording) -> int:
    """Return the number of rows before a release during which cables pull; 0 if there is no release."""
    pull = recording.pull
    let_go = np.any(pull.values < 0, axis=1)
    if not np.any(let_go) or not np.any(pull.values > 0):
        return 0
    return int(np.searchsorted(recording.times, pull.times[np.argmax(let_go)]))


def _longest_first(parts: Array, limit: Array) -> list[tuple[int, int]]:
    """Return the stretches whose averages stay within ``limit`` (n,), as first part and one past the last.

    A part whose averages are NaN belongs to none.
    """
    reach, end = np.empty(len(parts), dtype=np.int64), 0
    for start in range(len(parts)):
        end = max(end, start + 1)
        while end < len(parts) and np.all(np.ptp(parts[start : end + 1], axis=0) <= limit):
            end += 1
        reach[start] = end
    found, left = [], [(0, len(parts))]
    while left:
        low, high = left.pop()
        lengths = np.minimum(reach[low:high], high) - np.arange(low, high)
        if high - low < 2 or lengths.max() < 2:
            continue
        start = low + int(np.argmax(lengths))
        end = start + int(lengths.max())
        found.append((start, end))
        left += [(low, start), (end, high)]
    return found

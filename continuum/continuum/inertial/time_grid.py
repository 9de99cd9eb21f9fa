"""Streams of sensors that were started at different instants, resampled to one grid of times.

A sensor that integrates internally gives means over its period, so that the sum of its readings is the exact turn (and
gain of speed) at the instants of its readings. That sum is smooth: it is interpolated by a cubic spline, and its
differences over the grid's periods are means again. A stream whose instants are the grid's stays unchanged.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from continuum.arrays import Array
from continuum.errors import MeasurementError
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.imu_sample import Truths

_BREAK = 1.5  # periods between readings, beyond which some are missing
_SAME_PERIOD = 0.01
_FEWEST = 4  # readings of a piece, for its spline
_LONGEST_GRID = 20  # times the number of readings; more than that cannot be missing
_SLACK = 0.02  # periods by which the grid may reach beyond a stream


@dataclass(frozen=True)
class Stream:
    """One sensor's readings, in its own axes.

    Attributes:
        name: name for messages.
        times: increasing times by a clock common to all streams, (k,) [s].
        rates: mean rates over the period before, (k, 3) [rad/s].
        forces: mean specific forces likewise, (k, 3) [m/s2].
        clipped: whether a reading was clipped, (k,).
    """

    name: str
    times: Array
    rates: Array
    forces: Array
    clipped: Truths

    @property
    def period(self) -> float:
        """Time between readings, estimated from the whole stream [s]."""
        return float((self.times[-1] - self.times[0]) / self._periods)

    @property
    def missing(self) -> float:
        """Fraction of readings that are missing between the first and the last, 0 to 1."""
        return 1 - self.times.size / (1 + self._periods)

    @property
    def _periods(self) -> int:
        """Number of periods from the first reading to the last, counted step by step: a clock's ticks may be coarse."""
        steps = np.diff(self.times)
        return int(np.sum(np.rint(steps / np.median(steps))))


def on_one_grid(streams: Sequence[Stream]) -> ImuRecording:
    """Return all streams over their common time; readings that one has missed are not valid.

    Raises:
        MeasurementError: different rates, too few readings, or no time in common.
    """
    for stream in streams:
        if stream.times.size < _FEWEST:
            raise MeasurementError(f"{stream.name} has only {stream.times.size} readings")
    period = streams[0].period
    for stream in streams:
        if abs(stream.period - period) > _SAME_PERIOD * period:
            raise MeasurementError(
                f"{stream.name} has {1 / stream.period:.1f} readings a second, {streams[0].name} {1 / period:.1f}"
            )
    begin, end = max(stream.times[0] for stream in streams), min(stream.times[-1] for stream in streams)
    if end - begin < _FEWEST * period:
        listed = ", ".join(f"{s.name} {s.times[0]:.1f} to {s.times[-1]:.1f} s" for s in streams)
        raise MeasurementError(f"no time is common to all sensors ({listed}): were they synchronised?")
    rows, most = (end - begin) / period, _LONGEST_GRID * max(stream.times.size for stream in streams)
    if rows > most:
        raise MeasurementError(f"{rows:.3g} periods of {period:g} s between so few readings: their times are damaged")
    times = begin + period * np.arange(int(rows + _SLACK) + 1)
    columns = [_on_grid(stream, times, period) for stream in streams]
    rates, forces, clipped, valid = (np.stack(block, axis=1) for block in zip(*columns, strict=True))
    return ImuRecording(times, rates, forces, clipped, valid)


def _on_grid(stream: Stream, times: Array, period: float) -> tuple[Array, Array, Truths, Truths]:
    """Return rates (n_times, 3), forces (n_times, 3), clipped and valid (n_times,)."""
    readings = np.concatenate([stream.rates, stream.forces], axis=1)
    found, valid = np.zeros((times.size, 6)), np.zeros(times.size, dtype=bool)
    slack = _SLACK * period
    for piece in _pieces(stream.times, period):
        if piece.size < _FEWEST:
            continue
        own = stream.times[piece]
        nodes = np.concatenate([[own[0] - period], own])
        total = CubicSpline(nodes, np.concatenate([np.zeros((1, 6)), np.cumsum(readings[piece], axis=0) * period]))
        inside = (times - period >= nodes[0] - slack) & (times <= nodes[-1] + slack)
        found[inside] = (total(times[inside]) - total(times[inside] - period)) / period
        valid |= inside
    after = np.clip(np.searchsorted(stream.times, times - slack), 0, stream.times.size - 1)
    before = np.maximum(after - 1, 0)
    apart = stream.times[after] - times > slack  # two readings share this period of the grid
    clipped = stream.clipped[after] | (apart & stream.clipped[before])
    return found[:, :3], found[:, 3:], clipped & valid, valid


def _pieces(times: Array, period: float) -> list[NDArray[np.intp]]:
    """Return the rows between breaks."""
    return np.split(np.arange(times.size), np.flatnonzero(np.diff(times) > _BREAK * period) + 1)

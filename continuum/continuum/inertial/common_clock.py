"""Streams of synchronised Xsens DOT sensors on one time axis, and a check of their synchronisation.

The check uses that the links of one arm move at the same time.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.signal import correlate, correlation_lags

from continuum.arrays import Array
from continuum.errors import MeasurementError
from continuum.inertial.dot_export import WRAP, DotExport
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.time_grid import Stream

MOST = 0.25
"""Largest shift in time between the links' speeds [s]; waves along the arm take 0.07 s."""

_MOVES = np.radians(3.0)  # rad/s, least standard deviation of a speed to compare

_FARTHEST = 600.0  # s between the starts of recordings of one test


def on_one_clock(exports: Sequence[DotExport]) -> list[Stream]:
    """Return streams with times from the earliest start [s]; synchronised sensors share their clock's origin.

    If the clock wrapped between the starts of two recordings, the later one counts on.

    Raises:
        MeasurementError: starts so far apart that the sensors cannot have been synchronised.
    """
    first = exports[0].ticks[0]
    # of each start from the first sensor's, within half a wrap
    starts = [int((export.ticks[0] - first + WRAP // 2) % WRAP - WRAP // 2) for export in exports]
    earliest = min(starts)
    late = (max(starts) - earliest) / 1e6
    if late > _FARTHEST:
        names = exports[int(np.argmin(starts))].name, exports[int(np.argmax(starts))].name
        raise MeasurementError(
            f"{names[1]} begins {late:.0f} s after {names[0]} by the sensors' clocks: not synchronised, or another test"
        )
    return [
        Stream(
            export.name,
            (export.ticks - export.ticks[0] + start - earliest) / 1e6,
            export.rates,
            export.forces,
            export.clipped,
        )
        for export, start in zip(exports, starts, strict=True)
    ]


def check_common_clock(recording: ImuRecording) -> None:
    """Refuse sensors whose motion is that of the others at another time.

    Shifts due to the arm hide smaller ones: this finds sensors that were not synchronised, but corrects none.

    Raises:
        MeasurementError: a shift of more than `MOST`; the message lists those of all sensors.
    """
    shifts = speed_shifts(recording)
    if np.abs(shifts).max() > MOST:
        listed = ", ".join(f"{shift:+.2f}" for shift in shifts)
        raise MeasurementError(
            f"the sensors move at different times ({listed} s after the last): were they synchronised beforehand?"
        )


def speed_shifts(recording: ImuRecording) -> Array:
    """Return the shift that best fits each sensor's speed to that of the last, (n,) [s]; 0 if it hardly moves."""
    speeds = np.where(recording.good, np.linalg.norm(recording.rates, axis=2), 0.0)
    speeds = speeds - speeds.mean(axis=0)
    lags = correlation_lags(len(speeds), len(speeds))
    best = [lags[np.argmax(correlate(speed, speeds[:, -1]))] for speed in speeds.T]
    moves = speeds.std(axis=0) > _MOVES
    return np.where(moves & moves[-1], best, 0) * float(np.median(np.diff(recording.times)))

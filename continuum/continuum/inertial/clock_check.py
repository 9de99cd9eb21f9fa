"""Whether clocks that should be common are: links of one arm move at the same time."""

from __future__ import annotations

import numpy as np
from scipy.signal import correlate, correlation_lags

from continuum.arrays import Array
from continuum.errors import MeasurementError
from continuum.inertial.imu_recording import ImuRecording

MOST = 0.25
"""By which the links' speeds may be shifted against each other [s]; waves along the arm take 0.07 s."""

_MOVES = np.radians(3.0)  # rad/s, standard deviation of a speed that tells something


def check_common_clock(recording: ImuRecording) -> None:
    """Refuse sensors whose motion is that of the others at another time.

    Shifts that the arm itself makes hide smaller ones: this finds sensors that were not synchronised, it corrects none.

    Raises:
        MeasurementError: a shift of more than `MOST`; every sensor's is told.
    """
    shifts = speed_shifts(recording)
    if np.abs(shifts).max() > MOST:
        listed = ", ".join(f"{shift:+.2f}" for shift in shifts)
        raise MeasurementError(
            f"the sensors move at different times ({listed} s after the last): were they synchronised beforehand?"
        )


def speed_shifts(recording: ImuRecording) -> Array:
    """By how much each sensor's speed is best shifted to be that of the last, (n,) [s]; 0 for one that hardly moves."""
    speeds = np.where(recording.good, np.linalg.norm(recording.rates, axis=2), 0.0)
    speeds = speeds - speeds.mean(axis=0)
    lags = correlation_lags(len(speeds), len(speeds))
    best = [lags[np.argmax(correlate(speed, speeds[:, -1]))] for speed in speeds.T]
    moves = speeds.std(axis=0) > _MOVES
    return np.where(moves & moves[-1], best, 0) * float(np.median(np.diff(recording.times)))

"""Angles of links over a recording from their rates alone, for axes near the vertical and for links that never rest.

If gravity does not show a link's angle at rest, only its rate does. The error of the angle grows with time by the error
of the bias, and with the angle by that of the gyroscope's scale. The bias is that of the longest rest, if there is one,
corrected by what gravity shows of it in motion (`bias_in_motion`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.errors import MeasurementError
from continuum.inertial.at_rest import bias_at_rest
from continuum.inertial.bias_in_motion import bias_in_motion
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.integrated_rate import integrated
from continuum.inertial.rotation_axis import axes_of_motion
from continuum.inertial.stillness import rests

# Standard deviations of a bias, the defaults of VQF (Laidig, Seel, Information Fusion 91, 2023).
_NEVER_RESTED = np.radians(0.5)  # rad/s
_AT_REST = np.radians(0.03)  # rad/s
_GROWS = np.radians(0.1) / np.sqrt(100.0)  # rad/s per square root of seconds since


@dataclass(frozen=True)
class RecordedTurn:
    """Links that turned about their axes.

    Attributes:
        times: (n_times,) [s].
        angle: angle since the first time, (n_times, n) [rad].
        rate: (n_times, n) [rad/s].
        axis: unit vectors in each sensor's axes, (n, 3).
        bias: bias of the gyroscopes, (n, 3) [rad/s].
        bias_error: standard deviation of the bias about the axis, by which the angle may drift, (n,) [rad/s].
    """

    times: Array
    angle: Array
    rate: Array
    axis: Array
    bias: Array
    bias_error: Array


def recorded_turn(recording: ImuRecording, first_turn: int = 1) -> RecordedTurn:
    """Return the angles of all links, each about its axis. Missing rates are interpolated linearly in time.

    Args:
        recording: recording of links that turn about fixed axes, by 5 degrees or more.
        first_turn: sign of the last link's first turn, as for `axes_of_motion`.

    Raises:
        InvalidValueError: ``first_turn`` is neither 1 nor -1.
        MeasurementError: a sensor clipped, or the motion does not show the axes.
    """
    clipped = [str(sensor + 1) for sensor in np.flatnonzero(recording.clipped.any(axis=0))]
    if clipped:
        raise MeasurementError(f"sensor {', '.join(clipped)} clipped: its turn is unknown")
    prior, uncertainty = _prior(recording)
    axis = axes_of_motion(recording, prior, first_turn)
    found = bias_in_motion(recording, axis, prior, uncertainty)
    rate = np.einsum("tni,ni->tn", recording.rates - found.bias, axis)
    for column, received in zip(rate.T, recording.good.T, strict=True):
        column[~received] = np.interp(recording.times[~received], recording.times[received], column[received])
    return RecordedTurn(recording.times, integrated(recording.times, rate), rate, axis, found.bias, found.error)


def _prior(recording: ImuRecording) -> tuple[Array, float]:
    """Return biases (n, 3), and their standard deviation during the recording [rad/s]."""
    found = rests(recording)
    if not found:
        return np.zeros((recording.n_sensors, 3)), float(_NEVER_RESTED)
    bias = bias_at_rest(recording.part(*max(found, key=lambda span: span[1] - span[0])))
    return bias, float(np.hypot(_AT_REST, _GROWS * np.sqrt(np.ptp(recording.times))))

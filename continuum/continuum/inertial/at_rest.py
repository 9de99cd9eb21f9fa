"""Readings at rest: the bias of the gyroscopes, and the zero, which is the specific force while the arm is straight."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError, MeasurementError
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.inclination import turned
from continuum.inertial.stillness import CREEP, SETTLED, unrest
from continuum.number_checks import finite_of_shape


def bias_at_rest(recording: ImuRecording) -> Array:
    """Return the mean rates of an arm at rest, (n, 3) [rad/s].

    Raises:
        MeasurementError: the arm moved, a sensor was hardly received, or the recording is too short; the message names
            every sensor at fault.
    """
    return _means_at_rest(recording, recording.rates, CREEP, "the bias can be found only at rest")


def force_at_rest(recording: ImuRecording) -> Array:
    """Return the mean specific forces of an arm at rest, (n, 3) [m/s2].

    Raises:
        MeasurementError: as for `bias_at_rest`.
    """
    return _means_at_rest(recording, recording.forces, SETTLED, "the zero can be set only at rest")


def zero_at_rest(recording: ImuRecording, axis: Array, posture: object | None = None) -> Array:
    """Return the specific forces (n, 3) [m/s2] at zero joint angles, from an arm at rest in a known posture.

    Args:
        recording: recording of the arm at rest.
        axis: axes of the sensors, unit vectors, (n, 3).
        posture: joint angles of the posture, (n,) [rad]; straight if None.

    Raises:
        MeasurementError: the arm moved.
        InvalidValueError: a posture of another size, or a joint beyond half a turn.
    """
    seen = force_at_rest(recording)
    if posture is None:
        return seen
    angles = finite_of_shape("posture", posture, (recording.n_sensors,))
    if np.abs(angles).max() > np.pi:
        raise InvalidValueError("posture", angles.tolist(), f"{angles.size} joint angles of up to half a turn [rad]")
    return turned(seen, axis, np.cumsum(angles))


def _means_at_rest(recording: ImuRecording, readings: Array, creep: float, rule: str) -> Array:
    moved = unrest(recording, creep)
    if moved:
        raise MeasurementError(f"{rule}: {'; '.join(moved)}")
    weights = recording.good[:, :, None]
    return np.asarray(np.where(weights, readings, 0.0).sum(axis=0) / weights.sum(axis=0))

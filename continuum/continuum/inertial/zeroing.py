"""The zero of every sensor: the specific force that it reads while the arm is straight."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.inertial.gyro_bias import force_at_rest
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.inclination import turned
from continuum.number_checks import finite_of_shape


def zero_at_rest(recording: ImuRecording, axis: Array, posture: object | None = None) -> Array:
    """Specific forces (n, 3) [m/s2] at zero joint angles, from an arm at rest in a known posture.

    Args:
        recording: of the arm at rest.
        axis: of the sensors, unit vectors, (n, 3).
        posture: joint angles that it is in, (n,) [rad]; straight without.

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

"""Samples of inertial sensors as `sensor_msgs/Imu`, by REP-145: raw data, no orientation."""

from __future__ import annotations

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Vector3
from sensor_msgs.msg import Imu

from continuum.arrays import Array
from continuum_hw_imu.sensor_quality import SensorQuality

NO_ORIENTATION = np.array([-1.0, *[0.0] * 8])
"""Of REP-145: the sensor says nothing of it."""


class ImuMessages:
    """Makes the messages of one sensor.

    Args:
        frame: name of the sensor's own frame, in which it measures.
        quality: of the sensor: its noise and its ranges.
    """

    def __init__(self, frame: str, quality: SensorQuality) -> None:
        self._frame = frame
        self._sure = _covariance(quality.rate_noise), _covariance(quality.force_noise)
        self._clipped = _covariance(quality.rate_range), _covariance(quality.force_range)

    def message(self, stamp: Time, rate: Array, force: Array, clipped: bool) -> Imu:
        """Angular rate (3,) [rad/s] and specific force (3,) [m/s^2]; where clipped, they may be anything in range."""
        message = Imu(angular_velocity=_vector(rate), linear_acceleration=_vector(force))
        message.header.stamp, message.header.frame_id = stamp, self._frame
        message.orientation_covariance = NO_ORIENTATION
        covariances = self._clipped if clipped else self._sure
        message.angular_velocity_covariance, message.linear_acceleration_covariance = covariances
        return message


def _vector(values: Array) -> Vector3:
    x, y, z = values.tolist()
    return Vector3(x=x, y=y, z=z)


def _covariance(deviation: float) -> Array:
    """Of three independent axes, row by row, (9,)."""
    return (deviation**2 * np.eye(3)).ravel()

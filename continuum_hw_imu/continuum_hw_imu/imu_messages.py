"""Samples of inertial sensors as `sensor_msgs/Imu` according to REP-145: raw data without orientation."""

from __future__ import annotations

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Vector3
from sensor_msgs.msg import Imu

from continuum.arrays import Array
from continuum_hw_imu.sensor_quality import SensorQuality

NO_ORIENTATION = np.array([-1.0, *[0.0] * 8])
"""Value of REP-145 for a quantity that the sensor does not measure."""


class ImuMessages:
    """Creates the messages of one sensor.

    Args:
        frame: name of the sensor's frame, in which it measures.
        quality: noise and ranges of the sensor.
    """

    def __init__(self, frame: str, quality: SensorQuality) -> None:
        self._frame = frame
        self._sure = _covariance(quality.rate_noise), _covariance(quality.force_noise)
        self._clipped = _covariance(quality.rate_range), _covariance(quality.force_range)

    def message(self, stamp: Time, rate: Array, force: Array, clipped: bool) -> Imu:
        """Return the message of an angular rate (3,) [rad/s] and a specific force (3,) [m/s^2].

        The covariances of clipped values cover the whole range.
        """
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
    """Return the covariance of three independent axes, row by row, (9,)."""
    return (deviation**2 * np.eye(3)).ravel()

"""Samples of inertial sensors as `sensor_msgs/Imu`, by REP-145: raw data, no orientation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Vector3
from sensor_msgs.msg import Imu

from continuum.arrays import Array

NO_ORIENTATION = [-1.0, *[0.0] * 8]
"""Of REP-145: the sensor says nothing of it."""


@dataclass(frozen=True)
class SensorNoise:
    """Standard deviations of one sensor's signals, the same along each axis, and what it can measure at most.

    Attributes:
        rate: of the angular rate [rad/s].
        force: of the specific force [m/s^2].
        largest_rate: range of the angular rate [rad/s].
        largest_force: range of the specific force [m/s^2].
    """

    rate: float
    force: float
    largest_rate: float
    largest_force: float


class ImuMessages:
    """Makes the messages of one sensor.

    Args:
        frame: name of the sensor's own frame, in which it measures.
        noise: of the sensor.
    """

    def __init__(self, frame: str, noise: SensorNoise) -> None:
        self._frame = frame
        self._rate, self._rate_clipped = _covariance(noise.rate), _covariance(noise.largest_rate)
        self._force, self._force_clipped = _covariance(noise.force), _covariance(noise.largest_force)

    def message(self, stamp: Time, rate: Array, force: Array, clipped: bool) -> Imu:
        """Angular rate (3,) [rad/s] and specific force (3,) [m/s^2]; where clipped, they may be anything in range."""
        message = Imu()
        message.header.stamp, message.header.frame_id = stamp, self._frame
        message.orientation_covariance = NO_ORIENTATION
        message.angular_velocity = Vector3(**dict(zip("xyz", rate.tolist(), strict=True)))
        message.angular_velocity_covariance = self._rate_clipped if clipped else self._rate
        message.linear_acceleration = Vector3(**dict(zip("xyz", force.tolist(), strict=True)))
        message.linear_acceleration_covariance = self._force_clipped if clipped else self._force
        return message


def _covariance(deviation: float) -> list[float]:
    return (deviation**2 * np.eye(3)).ravel().tolist()

"""One inertial sensor that turns about an axis that stands still, of which the truth is known."""

from dataclasses import dataclass

import numpy as np
from inertial_arm import DEG, GRAVITY, any_rotation

from continuum.arrays import Array
from continuum.inertial.imu_recording import ImuRecording


@dataclass(frozen=True)
class Turning:
    """The axis and the sensor's errors.

    Attributes:
        tilt: of the axis from the vertical [rad].
        bias: of the gyroscope about the axis [rad/s].
        force_bias: of the accelerometer, standard deviation, at the start and by which it drifts [m/s2].
        rate_noise, force_noise: of readings, standard deviation [rad/s, m/s2].
        lever: of the sensor from the axis [m].
        scale: of the gyroscope.
    """

    tilt: float = 0.3 * DEG
    bias: float = 0.1 * DEG
    force_bias: float = 0.03
    rate_noise: float = 0.05 * DEG
    force_noise: float = 0.05
    lever: float = 0.02
    scale: float = 1.0


PERIOD = 0.01  # s


def back_and_forth(duration: float, turn: float = 180 * DEG, time: float = 4.0) -> tuple[Array, Array]:
    """Times and angles [rad] of a motor that goes to ``turn`` in ``time`` [s] and back, smoothly."""
    times = np.arange(0, duration, PERIOD)
    return times, turn * (1 - np.cos(np.pi * times / time)) / 2


def sensed_turn(
    times: Array, angle: Array, sensor: Turning, rng: np.random.Generator, mount: Array | None = None
) -> tuple[ImuRecording, Array]:
    """Readings of a sensor that is mounted in any way or a given one (3, 3), and the axis in it, (1, 3)."""
    if mount is None:
        mount = any_rotation(rng)
        mount *= np.sign(np.linalg.det(mount))
    zero, one = np.zeros_like(angle), np.ones_like(angle)
    rate = np.gradient(angle, times)
    turned = np.stack([np.cos(angle), -np.sin(angle), zero], axis=1)  # what is fixed and along x, seen from the link
    across = sensor.lever * np.stack([-(rate**2), np.gradient(rate, times), zero], axis=1)
    force = GRAVITY * (np.sin(sensor.tilt) * turned + np.cos(sensor.tilt) * one[:, None] * [0, 0, 1]) + across
    drift = rng.normal(size=(2, 3)) * sensor.force_bias
    force = force + drift[0] + np.linspace(0, 1, times.size)[:, None] * drift[1]
    spin = np.stack([zero, zero, sensor.scale * rate + sensor.bias], axis=1)
    spin = spin + rng.normal(scale=sensor.rate_noise, size=spin.shape)
    force = force + rng.normal(scale=sensor.force_noise, size=force.shape)
    received = np.ones((times.size, 1), dtype=bool)
    return ImuRecording(times, (spin @ mount)[:, None], (force @ mount)[:, None], ~received, received), mount.T[:, 2][
        None
    ]

"""Model of real inertial sensors: misaligned on their discs, biased, noisy and of limited range."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

from continuum.arrays import Array
from continuum_hw_imu.protocol.messages import ImuFrame
from continuum_hw_imu.protocol.messages.imu import CLIPPED_FORCE, CLIPPED_RATE, PRESENT
from continuum_hw_imu.sensor_quality import SensorQuality


@dataclass
class SensorModel:
    """The sensors of an arm.

    Attributes:
        n: number of sensors.
        quality: quality of all sensors.
        random: generator of their errors.
        lost: numbers from 0 of sensors that give no data.
        narrowed: reduced ranges of rates [rad/s] of some sensors, by number from 0.
        mountings: rotation of each sensor, from its link's axes to the sensor's axes.
    """

    n: int
    quality: SensorQuality
    random: np.random.Generator
    lost: set[int] = field(default_factory=set)
    narrowed: dict[int, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        draw, quality = self.random.normal, self.quality
        self.mountings = Rotation.from_rotvec(draw(0.0, quality.mounting, (self.n, 3)))
        self._rate_bias = draw(0.0, quality.rate_bias, (self.n, 3))
        self._force_bias = draw(0.0, quality.force_bias, (self.n, 3))

    def widen(self, number: int) -> None:
        """Restore the full range of a sensor."""
        self.narrowed.pop(number, None)

    def frame(self, sample: int, turn_rates: Array, forces: Array, period: float) -> ImuFrame:
        """Return the sensors' frame for one sample.

        Args:
            sample: number of the sample.
            turn_rates: rotation rates of the links, (n,) [rad/s].
            forces: specific forces in axes of the links, (n, 3) [m/s^2].
            period: time since the previous sample [s].
        """
        draw, quality = self.random.normal, self.quality
        self._rate_bias += draw(0.0, quality.bias_walk * np.sqrt(period), (self.n, 3))
        rates = self.mountings.apply(turn_rates[:, None] * np.array([0.0, 1.0, 0.0]))
        rates = rates + self._rate_bias + draw(0.0, quality.rate_noise, (self.n, 3))
        seen = self.mountings.apply(forces) + self._force_bias + draw(0.0, quality.force_noise, (self.n, 3))
        limits = np.full((self.n, 1), quality.rate_range)
        for number, narrow in self.narrowed.items():
            limits[number] = narrow
        flags = (np.abs(rates) > limits) @ np.array(CLIPPED_RATE)
        flags += (np.abs(seen) > quality.force_range) @ np.array(CLIPPED_FORCE)
        flags += PRESENT
        rates = np.clip(rates, -limits, limits)
        seen = np.clip(seen, -quality.force_range, quality.force_range)
        for number in self.lost:
            rates[number], seen[number], flags[number] = 0.0, 0.0, 0
        return ImuFrame.of(sample % (1 << 16), rates, seen, flags)

"""Quality of inertial sensors, by default of the Xsens DOT, for the covariances of messages and for the emulator.

+-2000 deg/s and +-16 g, noise of 0.007 deg/s/sqrt(Hz) and 120 ug/sqrt(Hz) (data sheet), over the bandwidth of 30 Hz
of a mean over 1/60 s.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_G = 9.80665


@dataclass(frozen=True)
class SensorQuality:
    """Quality of the sensors: standard deviations and ranges; constant errors are drawn at the start.

    Attributes:
        rate_noise: noise of each angular rate [rad/s].
        force_noise: noise of each specific force [m/s^2].
        rate_bias: constant bias of each rate axis [rad/s].
        bias_walk: random walk of the rate bias [rad/s/sqrt(s)].
        force_bias: constant bias of each force axis [m/s^2].
        mounting: misalignment of a sensor on its disc about each axis [rad].
        rate_range: angular rate beyond which it clips [rad/s].
        force_range: specific force beyond which it clips [m/s^2].
    """

    rate_noise: float = np.radians(0.007 * np.sqrt(30.0))
    force_noise: float = 120e-6 * np.sqrt(30.0) * _G
    rate_bias: float = np.radians(0.3)
    bias_walk: float = np.radians(2e-4)
    force_bias: float = 3e-3 * _G
    mounting: float = np.radians(3.0)
    rate_range: float = np.radians(2000.0)
    force_range: float = 16.0 * _G

    def perfect(self) -> SensorQuality:
        """Return the same ranges without errors."""
        return SensorQuality(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, rate_range=self.rate_range, force_range=self.force_range)

"""How good inertial sensors are, the Xsens DOT's by default: for messages' covariances, and for the emulator.

+-2000 deg/s and +-16 g, noise of 0.007 deg/s/sqrt(Hz) and 120 ug/sqrt(Hz) (data sheet), over the half of 60 Hz that a
mean over 1/60 s lets through.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_G = 9.80665


@dataclass(frozen=True)
class SensorQuality:
    """How good the sensors are. Standard deviations but for the ranges; the constant ones are drawn at the start.

    Attributes:
        rate_noise: of each angular rate [rad/s].
        force_noise: of each specific force [m/s^2].
        rate_bias: constant, of each axis [rad/s].
        bias_walk: by which the bias wanders [rad/s/sqrt(s)].
        force_bias: constant, of each axis [m/s^2].
        mounting: by which a sensor is turned on its disc about each axis [rad].
        rate_range: beyond which it clips [rad/s].
        force_range: the same [m/s^2].
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
        """The same ranges, without any error."""
        return SensorQuality(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, rate_range=self.rate_range, force_range=self.force_range)

"""One synchronised instant of all inertial sensors.

    sample u16 | per sensor: angular rate x, y, z i16 | specific force x, y, z i16 | flags u8

The values are means over the interval since the previous sample, which ends at the frame's time. A sensor that
integrates internally (Xsens DOT: at 800 Hz) gives its increments divided by the interval. The cumulative sum times the
interval is therefore the angle, however fast the motion. Axes are those of the sensor.
"""

from __future__ import annotations

import math
import struct
from dataclasses import dataclass
from typing import ClassVar, NamedTuple, Self

import numpy as np

from continuum.arrays import Array
from continuum_hw_imu.protocol.messages.base import PayloadFault, counted

RATE_STEP = 0.0625
"""Step of angular rates [deg/s]; 16 bits span +-2047.9 deg/s, which includes a sensor's range of +-2000 deg/s."""

FORCE_STEP = 0.005
"""Step of specific forces [m/s^2]; 16 bits span +-163.8 m/s^2, 16.7 g."""

MOST_SENSORS = 10
LARGEST = 0x7FFF

CLIPPED_RATE = (0x01, 0x02, 0x04)
"""Flags: the rate about x, y, z exceeded the sensor's range within the interval."""

CLIPPED_FORCE = (0x08, 0x10, 0x20)
CLIPPED = 0x3F
PRESENT = 0x80
"""Flag: the sensor's values belong to this instant. Without it they are zero and meaningless."""

_SENSOR = struct.Struct("<6hB")
_SAMPLE = struct.Struct("<H")


class Reading(NamedTuple):
    """Values of one sensor in steps, as on the line."""

    rate_x: int
    rate_y: int
    rate_z: int
    force_x: int
    force_y: int
    force_z: int
    flags: int


@dataclass(frozen=True)
class ImuFrame:
    """Values of all sensors at one instant.

    Attributes:
        sample: number of the instant modulo 2^16; missing numbers were never measured.
        readings: reading of each sensor, in the order of `Hello.sensors`.
    """

    TYPE: ClassVar[int] = 0x02

    sample: int
    readings: tuple[Reading, ...]

    @classmethod
    def of(cls, sample: int, rates: Array, forces: Array, flags: Array) -> Self:
        """Return the frame of angular rates (n, 3) [rad/s], specific forces (n, 3) [m/s^2] and flags (n,).

        Values are clipped to the range; the flags should indicate this.
        """
        values = np.hstack([np.degrees(rates) / RATE_STEP, forces / FORCE_STEP])
        steps = np.clip(np.rint(values), -LARGEST, LARGEST).astype(int).tolist()
        return cls(sample, tuple(Reading._make([*row, int(flag)]) for row, flag in zip(steps, flags, strict=True)))

    def encode(self) -> bytes:
        counted("number of sensors", len(self.readings), MOST_SENSORS, 1)
        return _SAMPLE.pack(self.sample) + b"".join(_SENSOR.pack(*reading) for reading in self.readings)

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        sensors, rest = divmod(len(payload) - _SAMPLE.size, _SENSOR.size)
        if rest or not 1 <= sensors <= MOST_SENSORS:
            raise PayloadFault(f"{len(payload)} bytes; allowed: 2 and 13 for each of 1 to {MOST_SENSORS} sensors")
        parts = _SENSOR.iter_unpack(payload[_SAMPLE.size :])
        return cls(_SAMPLE.unpack_from(payload)[0], tuple(Reading(*part) for part in parts))

    @property
    def angular_rates(self) -> Array:
        """Angular rates (n, 3) [rad/s]."""
        return self._numbers()[:, :3] * math.radians(RATE_STEP)

    @property
    def specific_forces(self) -> Array:
        """Specific forces (n, 3) [m/s^2]; at rest they point up with 9.8 m/s^2."""
        return self._numbers()[:, 3:6] * FORCE_STEP

    @property
    def clipped(self) -> Array:
        """Whether any value of each sensor exceeded its range, (n,) of bool."""
        return np.array([bool(reading.flags & CLIPPED) for reading in self.readings])

    @property
    def present(self) -> Array:
        """Whether the values of each sensor belong to this instant, (n,) of bool."""
        return np.array([bool(reading.flags & PRESENT) for reading in self.readings])

    def _numbers(self) -> Array:
        return np.array(self.readings, dtype=float)

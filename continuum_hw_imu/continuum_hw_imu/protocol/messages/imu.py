"""One synchronised instant of all inertial sensors.

    sample u16 | per sensor: angular rate x, y, z i16 | specific force x, y, z i16 | flags u8

The values are means over the interval since the sample before, whose end is the frame's time: a sensor that integrates
inside (Xsens DOT: at 800 Hz) gives them as its increments by the interval. So their running sum times the interval is
the angle, however fast it went. Axes are the sensor's own.
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
"""[deg/s]; the range of 16 bits is +-2047.9 deg/s, a sensor's +-2000 within."""

FORCE_STEP = 0.005
"""[m/s^2]; the range of 16 bits is +-163.8 m/s^2, 16.7 g."""

MOST_SENSORS = 10
LARGEST = 0x7FFF

CLIPPED_RATE = (0x01, 0x02, 0x04)
"""Flags: the rate about x, y, z left the sensor's range within the interval."""

CLIPPED_FORCE = (0x08, 0x10, 0x20)
CLIPPED = 0x3F
PRESENT = 0x80
"""Flag: the sensor's values are of this instant. Without it they are zero, and mean nothing."""

_SENSOR = struct.Struct("<6hB")
_SAMPLE = struct.Struct("<H")


class Reading(NamedTuple):
    """One sensor's part, in steps as on the line."""

    rate_x: int
    rate_y: int
    rate_z: int
    force_x: int
    force_y: int
    force_z: int
    flags: int


@dataclass(frozen=True)
class ImuFrame:
    """What the sensors measured.

    Attributes:
        sample: number of the instant modulo 2^16; one that is missing was never measured.
        readings: of each sensor, in the order of `Hello.sensors`.
    """

    TYPE: ClassVar[int] = 0x02

    sample: int
    readings: tuple[Reading, ...]

    @classmethod
    def of(cls, sample: int, rates: Array, forces: Array, flags: Array) -> Self:
        """Of angular rates (n, 3) [rad/s], specific forces (n, 3) [m/s^2] and flags (n,) of the sensors.

        What is beyond the range becomes its end, which the flags should tell.
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
        """(n, 3) [rad/s]."""
        return self._numbers()[:, :3] * math.radians(RATE_STEP)

    @property
    def specific_forces(self) -> Array:
        """(n, 3) [m/s^2]; at rest it points up, 9.8 m/s^2 long."""
        return self._numbers()[:, 3:6] * FORCE_STEP

    @property
    def clipped(self) -> Array:
        """Of each sensor, whether anything left its range, (n,) of bool."""
        return np.array([bool(reading.flags & CLIPPED) for reading in self.readings])

    @property
    def present(self) -> Array:
        """Of each sensor, whether its values are of this instant, (n,) of bool."""
        return np.array([bool(reading.flags & PRESENT) for reading in self.readings])

    def _numbers(self) -> Array:
        return np.array(self.readings, dtype=float)

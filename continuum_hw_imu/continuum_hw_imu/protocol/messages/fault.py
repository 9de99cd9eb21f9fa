"""Something went wrong at the device just now; told once as it begins. What still holds is in `Status`.

code u8 | subject u8
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from enum import IntEnum
from typing import ClassVar, Self

from continuum_hw_imu.protocol.messages.base import member, of_size

_FORM = struct.Struct("<BB")


class FaultCode(IntEnum):
    """What. In `Status.faults` the bit ``1 << code`` stands as long as it holds."""

    SENSOR_LOST = 0
    """The controller has no values of a sensor; subject: its number from 1."""
    BATTERY_LOW = 1
    """Of a sensor, below 15 percent; subject: its number from 1."""
    COMMANDS_STOPPED = 2
    """A cable was tight and no set point came: it is let go."""
    HEARTBEATS_STOPPED = 3
    """Nothing came from the commander: its claim has ended."""
    ACTUATOR = 4
    """A cable does not follow its set point; subject: its number from 1."""
    OVERRUN = 5
    """The controller is late with its own work."""


@dataclass(frozen=True)
class Fault:
    """One event.

    Attributes:
        code: what.
        subject: number of the sensor or cable from 1; 0 where it is none.
    """

    TYPE: ClassVar[int] = 0x06

    code: FaultCode
    subject: int = 0

    def encode(self) -> bytes:
        return _FORM.pack(self.code, self.subject)

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        code, subject = _FORM.unpack(of_size(payload, _FORM.size))
        return cls(member(FaultCode, code), subject)

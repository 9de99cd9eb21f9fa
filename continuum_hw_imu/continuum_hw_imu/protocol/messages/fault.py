"""A fault of the device, sent once when it starts. `Status` contains the active faults.

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
    """Kind of fault. In `Status.faults` the bit ``1 << code`` is set while it is active."""

    SENSOR_LOST = 0
    """The controller receives no values from a sensor; subject: its number from 1."""
    BATTERY_LOW = 1
    """The battery of a sensor is below 15 percent; subject: its number from 1."""
    COMMANDS_STOPPED = 2
    """A cable was tight and no set point arrived: it is released."""
    HEARTBEATS_STOPPED = 3
    """The commander was silent: its claim has ended."""
    ACTUATOR = 4
    """A cable does not follow its set point; subject: its number from 1."""
    OVERRUN = 5
    """The controller is behind schedule."""


@dataclass(frozen=True)
class Fault:
    """One fault.

    Attributes:
        code: kind of fault.
        subject: number of the sensor or cable, from 1; 0 for neither.
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

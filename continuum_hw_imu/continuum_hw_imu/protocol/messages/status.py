"""The device's heartbeat, ten times a second and whenever its state changes.

state u8 | cause u8 | claimed u8 | faults u16 | frames received u16 | frames refused u16 | battery u8 per sensor [%]
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from enum import IntEnum
from typing import ClassVar, Self

from continuum_hw_imu.protocol.messages.base import PayloadFault, counted, member
from continuum_hw_imu.protocol.messages.imu import MOST_SENSORS

_FORM = struct.Struct("<BBBHHH")
_UNKNOWN = 255


class GuardState(IntEnum):
    """State of the receiver."""

    SLACK = 0
    """No tension, and no command in force."""
    FOLLOWING = 1
    """Set points of the commander are in force."""
    LETTING_GO = 2
    """The tension is on its ramp to zero."""
    STOPPED = 3
    """The cables are slack until a reset."""


class Cause(IntEnum):
    """Cause of the last release of the cables."""

    START = 0
    RELEASED = 1
    """The commander gave back its claim, or requested a release."""
    COMMANDS_STOPPED = 2
    HEARTBEATS_STOPPED = 3
    LINK_LOST = 4
    """The host's end of the port was closed, or unplugged."""
    STOP = 5
    CLAIMED_AGAIN = 6
    """The commander claimed again, as after a restart."""


@dataclass(frozen=True)
class Status:
    """Status of the device.

    Attributes:
        state: state of the receiver.
        cause: cause of the last release of the cables.
        claimed: whether there is a commander.
        faults: bits ``1 << FaultCode`` of the active faults.
        received: number of valid frames from the host since the start, modulo 2^16.
        refused: number of invalid frames from the host, modulo 2^16.
        batteries: charge of each sensor [%], None where it is unknown.
    """

    TYPE: ClassVar[int] = 0x05

    state: GuardState
    cause: Cause
    claimed: bool
    faults: int
    received: int
    refused: int
    batteries: tuple[int | None, ...]

    def encode(self) -> bytes:
        counted("number of batteries", len(self.batteries), MOST_SENSORS)
        head = _FORM.pack(self.state, self.cause, self.claimed, self.faults, self.received, self.refused)
        return head + bytes(
            _UNKNOWN if charge is None else counted("battery", charge, 100) for charge in self.batteries
        )

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        if not 0 <= len(payload) - _FORM.size <= MOST_SENSORS:
            raise PayloadFault(f"{len(payload)} bytes; allowed: {_FORM.size} to {_FORM.size + MOST_SENSORS}")
        state, cause, claimed, faults, received, refused = _FORM.unpack_from(payload)
        charges = payload[_FORM.size :]
        if claimed > 1 or any(100 < charge < _UNKNOWN for charge in charges):
            raise PayloadFault("a truth value above 1, or a charge above 100 %")
        batteries = tuple(None if charge == _UNKNOWN else charge for charge in charges)
        return cls(member(GuardState, state), member(Cause, cause), bool(claimed), faults, received, refused, batteries)

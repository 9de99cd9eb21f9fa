"""The answer to a request: its identity and its result.

sequence u16 | type u8 | result u8
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from enum import IntEnum
from typing import ClassVar, Self

from continuum_hw_imu.protocol.messages.base import member, of_size

_FORM = struct.Struct("<HBB")


class Result(IntEnum):
    """Result of a request."""

    DONE = 0
    LIMITED = 1
    """Done, with tensions clipped to the receiver's limit."""
    NOT_COMMANDER = 2
    """The token is not that of the claim, or there is no claim."""
    BUSY = 3
    """Another host commands."""
    NOT_SLACK = 4
    """Cables are still being released; claim or reset again when they are slack."""
    STALE = 5
    """The command was decided too long ago, or before the claim or the last stop."""
    OUT_OF_ORDER = 6
    """A later command arrived earlier."""
    STOPPED = 7
    """Stopped until a reset."""
    REFUSED = 8
    """The number of tensions differs from that of the cables, or one is not a number >= 0."""


@dataclass(frozen=True)
class Ack:
    """One answer.

    Attributes:
        sequence: sequence number of the answered frame.
        request: type of its message.
        result: result of the request.
    """

    TYPE: ClassVar[int] = 0x04

    sequence: int
    request: int
    result: Result

    def encode(self) -> bytes:
        return _FORM.pack(self.sequence, self.request, self.result)

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        sequence, request, result = _FORM.unpack(of_size(payload, _FORM.size))
        return cls(sequence, request, member(Result, result))

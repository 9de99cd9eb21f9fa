"""The answer to a request: which one, and what became of it.

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
    """What became of a request."""

    DONE = 0
    LIMITED = 1
    """Done, with tensions above the receiver's limit taken for the limit."""
    NOT_COMMANDER = 2
    """The token is not that of the claim, or there is no claim."""
    BUSY = 3
    """Another one commands."""
    NOT_SLACK = 4
    """Cables are still let go; claim, or reset, again when they are slack."""
    STALE = 5
    """What the command was decided on is too old, or older than the claim or the last stop."""
    OUT_OF_ORDER = 6
    """A later command was there before."""
    STOPPED = 7
    """Stopped, until it is reset."""
    REFUSED = 8
    """Not one tension for each cable, or one that is no number >= 0."""


@dataclass(frozen=True)
class Ack:
    """One answer.

    Attributes:
        sequence: of the frame that is answered.
        request: the type of its message.
        result: what became of it.
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

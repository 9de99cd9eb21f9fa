"""One frame: who sent what, as which in a row, and when; and how it stands on the line.

    00  COBS( version u8 | type u8 | sequence u16 | time u32 [us] | payload | CRC-32 )  00

All numbers are little-endian. The zero in front parts a frame from noise on an idle line.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

from continuum.errors import InvalidValueError
from continuum_hw_imu.protocol import checksum, cobs
from continuum_hw_imu.protocol.messages import Message

VERSION = 1
"""Of the protocol; a frame of another is told as such, and not read."""

HEADER = struct.Struct("<BBHI")
LONGEST_BODY = 254
"""[bytes], so that COBS adds one byte and no more."""

LONGEST_PAYLOAD = LONGEST_BODY - HEADER.size - checksum.SIZE
LONGEST_CODED = LONGEST_BODY + 1
"""Bytes between two zeros."""

WRAP_SEQUENCE = 1 << 16
WRAP_TIME = 1 << 32


@dataclass(frozen=True)
class Frame:
    """What one end says at one instant.

    Attributes:
        sequence: counts the sender's frames, of all types together, modulo 2^16.
        time: the sender's clock [us] modulo 2^32: of what was measured, or else of sending.
        message: of one of the types in `messages`.
    """

    sequence: int
    time: int
    message: Message

    def encode(self) -> bytes:
        """All bytes on the line, both zeros included.

        Raises:
            InvalidValueError: the message holds what its fields on the line cannot.
        """
        payload = self.message.encode()
        if len(payload) > LONGEST_PAYLOAD:
            raise InvalidValueError("payload", len(payload), f"at most {LONGEST_PAYLOAD} bytes")
        header = HEADER.pack(VERSION, self.message.TYPE, self.sequence % WRAP_SEQUENCE, self.time % WRAP_TIME)
        return b"\0" + cobs.encoded(checksum.sealed(header + payload)) + b"\0"


class FrameWriter:
    """Numbers what one end sends."""

    def __init__(self) -> None:
        self.sequence = 0
        """Of the next frame."""

    def write(self, message: Message, time: int) -> bytes:
        """The bytes of the next frame; ``time`` of the sender's clock [us]."""
        coded = Frame(self.sequence, time, message).encode()
        self.sequence = (self.sequence + 1) % WRAP_SEQUENCE
        return coded

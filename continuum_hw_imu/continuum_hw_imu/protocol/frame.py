"""One frame: a message with its sequence number and time, and its layout on the line.

    00  COBS( version u8 | type u8 | sequence u16 | time u32 [us] | payload | CRC-32 )  00

All numbers are little-endian. The leading zero separates a frame from noise on an idle line.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass

from continuum.errors import InvalidValueError
from continuum_hw_imu.protocol import checksum, cobs
from continuum_hw_imu.protocol.messages import Message

VERSION = 1
"""Version of the protocol; frames of another version are reported and not read."""

HEADER = struct.Struct("<BBHI")
LONGEST_BODY = 254
"""Longest payload [bytes], so that COBS adds only one byte."""

LONGEST_PAYLOAD = LONGEST_BODY - HEADER.size - checksum.SIZE
LONGEST_CODED = LONGEST_BODY + 1
"""Most bytes between two zeros."""

WRAP_SEQUENCE = 1 << 16
WRAP_TIME = 1 << 32


@dataclass(frozen=True)
class Frame:
    """A message of one end at one instant.

    Attributes:
        sequence: count of the sender's frames of all types, modulo 2^16.
        time: the sender's clock [us] modulo 2^32 at the measurement, or for other messages at the transmission.
        message: message of one of the types in `messages`.
    """

    sequence: int
    time: int
    message: Message

    def encode(self) -> bytes:
        """Return all bytes on the line, including both zeros.

        Raises:
            InvalidValueError: a value of the message exceeds its field on the line.
        """
        payload = self.message.encode()
        if len(payload) > LONGEST_PAYLOAD:
            raise InvalidValueError("payload", len(payload), f"at most {LONGEST_PAYLOAD} bytes")
        header = HEADER.pack(VERSION, self.message.TYPE, self.sequence % WRAP_SEQUENCE, self.time % WRAP_TIME)
        return b"\0" + cobs.encoded(checksum.sealed(header + payload)) + b"\0"


class FrameWriter:
    """Writer of one end, which numbers its frames."""

    def __init__(self) -> None:
        self.sequence = 0
        """Sequence number of the next frame."""

    def write(self, message: Message, time: int) -> bytes:
        """Return the bytes of the next frame with a ``time`` of the sender's clock [us]."""
        coded = Frame(self.sequence, time, message).encode()
        self.sequence = (self.sequence + 1) % WRAP_SEQUENCE
        return coded

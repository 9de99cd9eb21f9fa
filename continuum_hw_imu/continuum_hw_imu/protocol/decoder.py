"""Decode frames from bytes in pieces of any size. The decoder never raises, and stores at most one frame's bytes.

The bytes between two zeros are a frame or count as one error; the next zero resynchronises, so that garbage affects
only the frames that it touches.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from enum import StrEnum

from continuum_hw_imu.protocol import checksum, cobs
from continuum_hw_imu.protocol.frame import HEADER, LONGEST_CODED, VERSION, Frame
from continuum_hw_imu.protocol.messages import OF_DEVICE, OF_HOST, Message, PayloadFault


class Garbage(StrEnum):
    """Reason why the bytes between two zeros are not a frame."""

    TOO_LONG = "too long"
    TOO_SHORT = "too short"
    NOT_COBS = "not COBS"
    CHECKSUM = "checksum"
    VERSION = "other version"
    UNKNOWN_TYPE = "unknown type"
    PAYLOAD = "payload"


class Decoder:
    """Decoder of one end of the line.

    Args:
        types: the message types that this end receives.

    Attributes:
        good: number of frames so far.
        errors: number of errors so far, by kind of garbage.
        waiting: number of bytes that are stored until a zero arrives.
        other_version: version of the last valid frame with another protocol version; None before the first.
    """

    def __init__(self, types: Iterable[type[Message]]) -> None:
        self._types = {kind.TYPE: kind for kind in types}
        self._kept = b""
        self._skipping = False
        self.good = 0
        self.errors: Counter[Garbage] = Counter()
        self.other_version: int | None = None

    @classmethod
    def of_host(cls) -> Decoder:
        """Return the decoder of a host."""
        return cls(OF_DEVICE)

    @classmethod
    def of_device(cls) -> Decoder:
        """Return the decoder of a device."""
        return cls(OF_HOST)

    @property
    def waiting(self) -> int:
        return len(self._kept)

    @property
    def refused(self) -> int:
        """Total number of errors."""
        return self.errors.total()

    def forget(self) -> None:
        """Drop stored bytes after the line was cut."""
        self._kept, self._skipping = b"", False

    def feed(self, data: bytes) -> list[Frame]:
        """Return the frames that ``data`` completes."""
        *whole, rest = (self._kept + data).split(b"\0")
        self._kept = b""
        frames = []
        for stretch in whole:
            frame = None if self._skipping else self._read(stretch)
            self._skipping = False
            if frame is not None:
                frames.append(frame)
        self._keep(rest)
        return frames

    def _keep(self, stretch: bytes) -> None:
        """Store an incomplete stretch, unless it is too long already."""
        if self._skipping:
            return
        if len(stretch) > LONGEST_CODED:
            self.errors[Garbage.TOO_LONG] += 1
            self._kept, self._skipping = b"", True
        else:
            self._kept = stretch

    def _read(self, stretch: bytes) -> Frame | None:
        """Return the frame in a complete stretch between two zeros; count an error and return None otherwise."""
        if not stretch:
            return None  # two zeros in a row
        found = self._frame(stretch)
        if isinstance(found, Frame):
            self.good += 1
            return found
        self.errors[found] += 1
        return None

    def _frame(self, stretch: bytes) -> Frame | Garbage:
        if len(stretch) > LONGEST_CODED:
            return Garbage.TOO_LONG
        body = cobs.decoded(stretch)
        if body is None:
            return Garbage.NOT_COBS
        if len(body) < HEADER.size + checksum.SIZE:
            return Garbage.TOO_SHORT
        content = checksum.opened(body)
        if content is None:
            return Garbage.CHECKSUM
        version, number, sequence, time = HEADER.unpack_from(content)
        if version != VERSION:
            self.other_version = version
            return Garbage.VERSION
        kind = self._types.get(number)
        if kind is None:
            return Garbage.UNKNOWN_TYPE
        try:
            return Frame(sequence, time, kind.decode(content[HEADER.size :]))
        except PayloadFault:
            return Garbage.PAYLOAD

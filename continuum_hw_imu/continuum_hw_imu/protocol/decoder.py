"""From bytes in pieces of any size to frames. Never raises, and keeps no more than one frame's bytes.

Whatever stands between two zeros is a frame or counts as one error; the next zero starts afresh, so garbage costs the
frames that it touches and no others.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from enum import StrEnum

from continuum_hw_imu.protocol import checksum, cobs
from continuum_hw_imu.protocol.frame import HEADER, LONGEST_CODED, VERSION, Frame
from continuum_hw_imu.protocol.messages import OF_DEVICE, OF_HOST, Message, PayloadFault


class Garbage(StrEnum):
    """Why bytes between two zeros were no frame."""

    TOO_LONG = "too long"
    TOO_SHORT = "too short"
    NOT_COBS = "not COBS"
    CHECKSUM = "checksum"
    VERSION = "other version"
    UNKNOWN_TYPE = "unknown type"
    PAYLOAD = "payload"


class Decoder:
    """One end's ear.

    Args:
        types: the messages that this end understands.

    Attributes:
        good: number of frames so far.
        errors: how often each kind of garbage came so far.
        waiting: number of bytes that are kept until a zero comes.
        other_version: the last version of a sound frame that was not this one's; None before any.
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
        """What a host listens with."""
        return cls(OF_DEVICE)

    @classmethod
    def of_device(cls) -> Decoder:
        """What a device listens with."""
        return cls(OF_HOST)

    @property
    def waiting(self) -> int:
        return len(self._kept)

    @property
    def refused(self) -> int:
        """All errors together."""
        return self.errors.total()

    def forget(self) -> None:
        """Drop what is waiting: the line was cut."""
        self._kept, self._skipping = b"", False

    def feed(self, data: bytes) -> list[Frame]:
        """The frames that ``data`` completes."""
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
        """Keep a stretch that goes on with the next bytes, unless it is too long already."""
        if self._skipping:
            return
        if len(stretch) > LONGEST_CODED:
            self.errors[Garbage.TOO_LONG] += 1
            self._kept, self._skipping = b"", True
        else:
            self._kept = stretch

    def _read(self, stretch: bytes) -> Frame | None:
        """The frame of a whole stretch between two zeros."""
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

"""What may happen to frames between the two ends."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np


class LineFaultKind(StrEnum):
    """What happens to a frame."""

    LOSE = "lose"
    DAMAGE = "damage"
    REPEAT = "repeat"
    LATE = "late"
    NOISE = "noise"
    """Random bytes before it."""


@dataclass(frozen=True)
class LineFault:
    """A fault of one direction of the line.

    Attributes:
        kind: what happens.
        share: to this part of the frames.
        until: when it ends [s].
        by: of LATE, the delay [s].
        size: of NOISE, the largest number of bytes.
    """

    kind: LineFaultKind
    share: float
    until: float
    by: float = 0.0
    size: int = 0


class FaultyLine:
    """One direction of the line. Pieces are frames with their zeros; times [s].

    Args:
        random: which frames are hit.

    Attributes:
        hit: number of frames that something happened to.
    """

    def __init__(self, random: np.random.Generator) -> None:
        self._random = random
        self._faults: list[LineFault] = []
        self.hit = 0

    def add(self, fault: LineFault) -> None:
        self._faults.append(fault)

    def clear(self) -> None:
        """No more faults."""
        self._faults.clear()

    def passed(self, piece: bytes, now: float) -> list[tuple[float, bytes]]:
        """The pieces that come out for one that goes in, each with its delay [s]."""
        self._faults = [fault for fault in self._faults if now < fault.until]
        out = [(0.0, piece)]
        for fault in self._faults:
            if self._random.random() < fault.share:
                self.hit += 1
                out = self._struck(fault, out)
        return out

    def _struck(self, fault: LineFault, pieces: list[tuple[float, bytes]]) -> list[tuple[float, bytes]]:
        match fault.kind:
            case LineFaultKind.LOSE:
                return []
            case LineFaultKind.DAMAGE:
                return [(delay, self._damaged(piece)) for delay, piece in pieces]
            case LineFaultKind.REPEAT:
                return pieces * 2
            case LineFaultKind.LATE:
                return [(delay + fault.by, piece) for delay, piece in pieces]
            case LineFaultKind.NOISE:
                size = int(self._random.integers(1, fault.size + 1))
                return [(delay, self._random.bytes(size) + piece) for delay, piece in pieces]

    def _damaged(self, piece: bytes) -> bytes:
        """With bits turned over, cut short, or with bytes too many."""
        spoiled, at = bytearray(piece), int(self._random.integers(0, max(len(piece), 1)))
        way = self._random.integers(0, 3)
        if way == 0 and spoiled:
            spoiled[at] ^= int(self._random.integers(1, 256))
        elif way == 1:
            del spoiled[at:]
        else:
            spoiled[at:at] = self._random.bytes(int(self._random.integers(1, 9)))
        return bytes(spoiled)


def pieces_of(data: bytes) -> list[bytes]:
    """``data`` cut between frames, each with the zeros around it, so that all of a frame stands in one piece."""
    *ended, rest = data.split(b"\0")
    pieces, zeros = [], b""
    for part in ended:
        zeros += b"\0"
        if part:
            pieces.append(zeros[:-1] + part + b"\0")
            zeros = b""
    return [*pieces, zeros + rest] if zeros or rest else pieces

"""Faults of frames on the line between host and device."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np


class LineFaultKind(StrEnum):
    """Kind of fault of a frame."""

    LOSE = "lose"
    DAMAGE = "damage"
    REPEAT = "repeat"
    LATE = "late"
    NOISE = "noise"
    """Random bytes precede the frame."""


@dataclass(frozen=True)
class LineFault:
    """A fault of one direction of the line.

    Attributes:
        kind: kind of the fault.
        share: fraction of the frames that are affected.
        until: end time of the fault [s].
        by: delay of LATE [s].
        size: largest number of bytes of NOISE.
    """

    kind: LineFaultKind
    share: float
    until: float
    by: float = 0.0
    size: int = 0


class FaultyLine:
    """One direction of the line. Pieces are frames with their zero bytes; times are in s.

    Args:
        random: generator that selects the affected frames.

    Attributes:
        hit: number of affected frames.
    """

    def __init__(self, random: np.random.Generator) -> None:
        self._random = random
        self._faults: list[LineFault] = []
        self.hit = 0

    def add(self, fault: LineFault) -> None:
        self._faults.append(fault)

    def clear(self) -> None:
        """Remove all faults."""
        self._faults.clear()

    def passed(self, piece: bytes, now: float) -> list[tuple[float, bytes]]:
        """Return the output pieces for one input piece, each with its delay [s]."""
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
        """Return a piece with flipped bits, truncated, or with extra bytes, within a frame: nothing is left of it."""
        content = piece.strip(b"\0")
        if len(content) < 2:
            return piece
        before, _, after = piece.partition(content)
        spoiled, at = bytearray(content), int(self._random.integers(1, len(content)))
        way = self._random.integers(0, 3)
        if way == 0:
            spoiled[at] ^= int(self._random.integers(1, 256))
        elif way == 1:
            del spoiled[at:]
        else:
            spoiled[at:at] = self._random.bytes(int(self._random.integers(1, 9)))
        return before + bytes(spoiled) + after


def pieces_of(data: bytes) -> list[bytes]:
    """Split ``data`` between frames, with the surrounding zeros, so that each frame is completely in one piece."""
    *ended, rest = data.split(b"\0")
    pieces, zeros = [], b""
    for part in ended:
        zeros += b"\0"
        if part:
            pieces.append(zeros[:-1] + part + b"\0")
            zeros = b""
    return [*pieces, zeros + rest] if zeros or rest else pieces

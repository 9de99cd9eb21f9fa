"""Bytes on their way, each piece with the time when it comes out."""

from __future__ import annotations

import heapq
from itertools import count

_MOST_WAITING = 1.0
"""What would wait longer for its turn [s] finds the sender's memory full."""


class LineQueue:
    """Times [s] of one clock.

    Args:
        baud: bits a second, ten to a byte; 0 for a line that takes no time.

    Attributes:
        dropped: pieces for which there was no room.
    """

    def __init__(self, baud: float = 0.0) -> None:
        self._seconds_per_byte = 10.0 / baud if baud > 0.0 else 0.0
        self._free = 0.0
        self._pieces: list[tuple[float, int, bytes]] = []
        self._order = count()
        self.dropped = 0

    def put(self, now: float, piece: bytes, delay: float = 0.0) -> None:
        """A piece is handed to the line now; it comes out a ``delay`` [s] later than it would."""
        if self._free - now > _MOST_WAITING:
            self.dropped += 1
            return
        if self._seconds_per_byte:
            self._free = now = max(now, self._free) + len(piece) * self._seconds_per_byte
        heapq.heappush(self._pieces, (now + delay, next(self._order), piece))

    def due(self, now: float) -> list[bytes]:
        """The pieces that have come out by now, in order."""
        pieces = []
        while self._pieces and self._pieces[0][0] <= now:
            pieces.append(heapq.heappop(self._pieces)[2])
        return pieces

    def clear(self) -> None:
        """The line was cut."""
        self._pieces.clear()
        self._free = 0.0

    @property
    def next(self) -> float | None:
        """When the next piece comes out."""
        return self._pieces[0][0] if self._pieces else None

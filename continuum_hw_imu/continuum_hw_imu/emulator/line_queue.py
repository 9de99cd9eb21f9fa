"""Queue of bytes in transmission, with the arrival time of each piece."""

from __future__ import annotations

import heapq
from itertools import count

_MOST_WAITING = 1.0
"""Longest waiting time of a piece [s]; beyond it the sender's buffer is full."""


class LineQueue:
    """Transmission queue; times [s] are those of one clock.

    Args:
        baud: speed [bit/s], with ten bits per byte; 0 for no transmission time.

    Attributes:
        dropped: number of pieces that were dropped because the buffer was full.
    """

    def __init__(self, baud: float = 0.0) -> None:
        self._seconds_per_byte = 10.0 / baud if baud > 0.0 else 0.0
        self._free = 0.0
        self._pieces: list[tuple[float, int, bytes]] = []
        self._order = count()
        self.dropped = 0

    def put(self, now: float, piece: bytes, delay: float = 0.0) -> None:
        """Put a piece on the line at the time ``now``, with an additional ``delay`` [s]."""
        if self._free - now > _MOST_WAITING:
            self.dropped += 1
            return
        if self._seconds_per_byte:
            self._free = now = max(now, self._free) + len(piece) * self._seconds_per_byte
        heapq.heappush(self._pieces, (now + delay, next(self._order), piece))

    def due(self, now: float) -> list[bytes]:
        """Remove and return the pieces that have arrived by ``now``, in order."""
        pieces = []
        while self._pieces and self._pieces[0][0] <= now:
            pieces.append(heapq.heappop(self._pieces)[2])
        return pieces

    def clear(self) -> None:
        """Drop all pieces after the line was cut."""
        self._pieces.clear()
        self._free = 0.0

    @property
    def next(self) -> float | None:
        """Return the arrival time of the next piece, or None."""
        return self._pieces[0][0] if self._pieces else None

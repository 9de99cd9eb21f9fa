"""Detect lost, repeated and late frames from their sequence numbers."""

from __future__ import annotations

from enum import StrEnum

from continuum_hw_imu.protocol.frame import WRAP_SEQUENCE

_REMEMBERED = 256
"""Number of past sequence numbers whose arrival is remembered."""

_LARGEST_GAP = 4096
"""Largest jump that can be a loss; a larger one means that the sender restarted."""


class Arrival(StrEnum):
    """Classification of a frame by its number."""

    NEW = "new"
    LATE = "late"
    """A later frame arrived before it."""
    REPEATED = "repeated"


class SequenceTracker:
    """Tracks the sequence numbers of one sender.

    Attributes:
        lost: number of frames that have not arrived so far.
        late, repeated: number of late and of repeated frames.
    """

    def __init__(self) -> None:
        self._newest: int | None = None
        self._missing = 0  # bit k: number newest - k has not arrived
        self.lost = 0
        self.late = 0
        self.repeated = 0

    def forget(self) -> None:
        """Accept any next number, after a restart of the sender or a cut of the line."""
        self._newest = None

    def take(self, sequence: int) -> Arrival:
        """Record a frame's number and return its classification."""
        if self._newest is None:
            self._begin(sequence)
            return Arrival.NEW
        ahead = (sequence - self._newest) % WRAP_SEQUENCE
        behind = WRAP_SEQUENCE - ahead
        if 0 < ahead <= _LARGEST_GAP:
            self._advance(sequence, ahead)
            return Arrival.NEW
        if ahead == 0 or behind < _REMEMBERED:
            return self._resolved(0 if ahead == 0 else behind)
        self._begin(sequence)
        return Arrival.NEW

    def _begin(self, sequence: int) -> None:
        self._newest, self._missing = sequence, 0

    def _advance(self, sequence: int, ahead: int) -> None:
        self.lost += ahead - 1
        gap = (1 << min(ahead, _REMEMBERED)) - 2  # all numbers in between, without the one that arrived
        self._missing = (self._missing << min(ahead, _REMEMBERED) | gap) & ((1 << _REMEMBERED) - 1)
        self._newest = sequence

    def _resolved(self, behind: int) -> Arrival:
        if not self._missing >> behind & 1:
            self.repeated += 1
            return Arrival.REPEATED
        self._missing &= ~(1 << behind)
        self.lost -= 1
        self.late += 1
        return Arrival.LATE

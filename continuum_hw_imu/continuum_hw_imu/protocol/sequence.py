"""Which frames did not come, came twice or too late, told from their numbers."""

from __future__ import annotations

from enum import StrEnum

from continuum_hw_imu.protocol.frame import WRAP_SEQUENCE

_REMEMBERED = 256
"""Numbers behind the newest of which it is known whether they came."""

_LARGEST_GAP = 4096
"""Numbers ahead that can be losses; a larger leap is a sender that began anew."""


class Arrival(StrEnum):
    """What a number says of its frame."""

    NEW = "new"
    LATE = "late"
    """A later one came before it."""
    REPEATED = "repeated"


class SequenceTracker:
    """Follows the numbers of one sender.

    Attributes:
        lost: frames that never came, as far as is known.
        late, repeated: frames of these kinds.
    """

    def __init__(self) -> None:
        self._newest: int | None = None
        self._missing = 0  # bit k: newest - k has not come
        self.lost = 0
        self.late = 0
        self.repeated = 0

    def forget(self) -> None:
        """The sender begins anew, or the line was cut: the next number is as good as any."""
        self._newest = None

    def take(self, sequence: int) -> Arrival:
        """Note a frame's number."""
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
        gap = (1 << min(ahead, _REMEMBERED)) - 2  # all between, not the one that came
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

"""Stamps of messages, and joining the messages of several sources with the same stamp."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from enum import Enum, auto
from typing import Protocol

from continuum_manipulator.nodekit.qos import STREAM

NANOSECONDS = 1_000_000_000


class Stamp(Protocol):
    """The fields of ``builtin_interfaces/Time``."""

    sec: int
    nanosec: int


def nanoseconds(stamp: Stamp) -> int:
    """Return the stamp as one integer [ns]."""
    return stamp.sec * NANOSECONDS + stamp.nanosec


def seconds(stamp: int) -> str:
    """Return the text of a stamp [ns], in seconds to the nanosecond."""
    return "{}.{:09d} s".format(*divmod(stamp, NANOSECONDS))


class Loss(Enum):
    """Reason why messages did not enter a complete set."""

    INCOMPLETE = auto()
    LATE = auto()
    REPEATED = auto()


class StampJoiner[Key: Hashable, Message]:
    """Collects one message of every key for each stamp and returns the complete sets in the order of their stamps.

    Stamps must be equal to the nanosecond: different instants are never mixed. Every source sends its stamps in rising
    order, so when a set is complete, older incomplete sets can no longer be completed and are given up.
    A source whose stamp goes back has started a new run (a recording played again, a simulation reset): all open sets
    are given up and the order restarts. Messages of the other sources then belong to the old run until they go back
    too, or until they are ``restart_gap`` past all stamps of the old run; a new source belongs to any run.

    Args:
        keys: the sources of a complete set.
        capacity: stamps kept open at once; beyond it the set that was opened first is given up. By default as many as
            wait in the queue of a source on a busy machine: what a queue still holds is not given up.
        restart_gap: time past the old run from which a message belongs to the new one in any case [ns].
        on_loss: called for every loss with its stamp [ns] and keys: the missing keys of an incomplete set, otherwise
            the keys of unused messages.

    Attributes:
        incomplete: number of sets given up.
        late: number of messages whose set was complete already, or that belong to an earlier run.
        repeated: number of further messages of a source with the same stamp; the first is used.
    """

    def __init__(
        self,
        keys: Iterable[Key],
        capacity: int = STREAM.depth,
        restart_gap: int = NANOSECONDS,
        on_loss: Callable[[Loss, int, frozenset[Key]], object] = lambda _loss, _stamp, _keys: None,
    ) -> None:
        self._keys = frozenset(keys)
        self._capacity = capacity
        self._restart_gap = restart_gap
        self._on_loss = on_loss
        self._open: dict[int, dict[Key, Message]] = {}
        self._last: int | None = None
        self._latest: dict[Key, int] = {}
        self._in_run = set(self._keys)
        self._old_run_end = 0
        self.incomplete = 0
        self.late = 0
        self.repeated = 0

    @property
    def waiting(self) -> int:
        """Number of incomplete sets."""
        return len(self._open)

    @property
    def first_waiting(self) -> tuple[int, frozenset[Key]] | None:
        """Stamp [ns] and missing keys of the set that was opened first; None if no set is incomplete."""
        for stamp, parts in self._open.items():
            return stamp, self._keys - parts.keys()
        return None

    def add(self, key: Key, stamp: int, message: Message) -> dict[Key, Message] | None:
        """Add a message of ``key`` at ``stamp`` [ns]; return the set that it completes, or None.

        Raises:
            KeyError: ``key`` is not one of the sources.
        """
        if key not in self._keys:
            raise KeyError(key)
        self._follow_run(key, stamp)
        if stamp == self._last or key not in self._in_run:
            self.late += 1
            self._on_loss(Loss.LATE, stamp, frozenset([key]))
            return None
        parts = self._open.setdefault(stamp, {})
        if key in parts:
            self.repeated += 1
            self._on_loss(Loss.REPEATED, stamp, frozenset([key]))
            return None
        parts[key] = message
        if len(parts) < len(self._keys):
            self._bound()
            return None
        del self._open[stamp]
        self._close_until(stamp)
        return parts

    def withdraw(self, key: Key, stamp: int, message: Message) -> bool:
        """Remove a waiting message, as if its set had been returned; return False if it is not waiting."""
        if self._open.get(stamp, {}).get(key) is not message:
            return False
        del self._open[stamp]
        self._close_until(stamp)
        return True

    def _follow_run(self, key: Key, stamp: int) -> None:
        """Record the sources of the newest run, and start a new run if one of its sources goes back."""
        before = self._latest.get(key)
        if before is not None and stamp < before:
            if key in self._in_run:
                self._old_run_end = max(self._latest.values())
                self._in_run = set(self._keys - self._latest.keys())
                self._last = None
                self._give_up(list(self._open))
            self._in_run.add(key)
        elif stamp > self._old_run_end + self._restart_gap:
            self._in_run.add(key)
        self._latest[key] = stamp

    def _close_until(self, stamp: int) -> None:
        self._last = stamp
        self._give_up([other for other in self._open if other < stamp])

    def _bound(self) -> None:
        surplus = len(self._open) - self._capacity
        if surplus > 0:
            self._give_up(list(self._open)[:surplus])

    def _give_up(self, stamps: list[int]) -> None:
        self.incomplete += len(stamps)
        for stamp in stamps:
            self._on_loss(Loss.INCOMPLETE, stamp, self._keys - self._open.pop(stamp).keys())

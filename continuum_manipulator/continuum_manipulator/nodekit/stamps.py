"""Instants of messages, and joining what several sources said at the same one."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from enum import Enum, auto
from typing import Protocol

NANOSECONDS = 1_000_000_000


class Stamp(Protocol):
    """The fields of ``builtin_interfaces/Time``."""

    sec: int
    nanosec: int


def nanoseconds(stamp: Stamp) -> int:
    """The stamp as one whole number [ns]."""
    return stamp.sec * NANOSECONDS + stamp.nanosec


def seconds(stamp: int) -> str:
    """A stamp [ns] in words, in seconds to the nanosecond."""
    return "{}.{:09d} s".format(*divmod(stamp, NANOSECONDS))


class Loss(Enum):
    """Why messages did not enter a set that was given out."""

    INCOMPLETE = auto()
    LATE = auto()
    REPEATED = auto()


class StampJoiner[Key: Hashable, Message]:
    """Collects one message of every key for each stamp and gives out the complete sets, in the order of their stamps.

    Stamps must be equal to the nanosecond: two instants are never mixed. Every source sends its stamps in rising order,
    so when a set is complete, the older ones that still miss a part can no longer be completed: they are given up.
    A source whose stamp goes back has started a new run (a recording played again, a simulation reset): all open sets
    are given up and the order starts anew. The other sources' messages are then of the old run until they go back too,
    or until they are ``restart_gap`` past all that the old run had said; a source not heard before belongs to any run.

    Args:
        keys: the sources of a complete set.
        capacity: stamps kept open at once; beyond it the set that was opened first is given up.
        restart_gap: how far past the old run a message must be to belong to the new one all the same [ns].
        told: called for every loss with its stamp [ns] and keys: of an incomplete set those that are missing, else
            those whose messages are not used.

    Attributes:
        incomplete: sets given up.
        late: messages whose set was given out already, or that are of a run that is over.
        repeated: messages that a source sent twice for one stamp; the first is used.
    """

    def __init__(
        self,
        keys: Iterable[Key],
        capacity: int = 200,
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
        """Stamps that still miss a part."""
        return len(self._open)

    def add(self, key: Key, stamp: int, message: Message) -> dict[Key, Message] | None:
        """Take a message of ``key`` at ``stamp`` [ns]; return the set that it completes, or None.

        Raises:
            KeyError: ``key`` is none of the sources.
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
        """Take a message that still waits out, as if its set had been given out; False if it does not wait."""
        if self._open.get(stamp, {}).get(key) is not message:
            return False
        del self._open[stamp]
        self._close_until(stamp)
        return True

    def _follow_run(self, key: Key, stamp: int) -> None:
        """Note which sources are in the newest run, and begin one where a source that was in it goes back."""
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

"""Events of one cause that come in bursts: all are counted, and a few lines say so."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass


@dataclass
class _Burst:
    started: float
    last: float
    said: float
    unsaid: int = 0
    total: int = 1
    detail: str = ""


class BurstLog:
    """Counts events by cause and logs a burst of one cause in a few lines: its first event at once, the rest summed up.

    A burst is over when its cause was quiet for ``quiet`` seconds; a long one is summed up every ``every`` seconds. Any
    thread may use it.

    Args:
        log: writes one line.
        now: a clock that never goes back [s].
        prefix: put before every line.
        quiet: [s]
        every: [s]
    """

    def __init__(
        self,
        log: Callable[[str], object],
        now: Callable[[], float],
        prefix: str = "",
        quiet: float = 1.0,
        every: float = 5.0,
    ) -> None:
        self._log = log
        self._now = now
        self._prefix = prefix
        self._quiet = quiet
        self._every = every
        self._lock = threading.RLock()
        self._bursts: dict[str, _Burst] = {}
        self._counts: Counter[str] = Counter()

    @property
    def counts(self) -> Counter[str]:
        """Events by cause so far."""
        with self._lock:
            return Counter(self._counts)

    @property
    def total(self) -> int:
        """Events of all causes."""
        return self.counts.total()

    def note(self, cause: str, detail: str, events: int = 1) -> bool:
        """Count an event, or several at once; whether a burst begins with it."""
        with self._lock:
            return self._note(cause, detail, events)

    def tick(self) -> None:
        """Say what is due; to be called about once a second."""
        with self._lock:
            self._tick()

    def _note(self, cause: str, detail: str, events: int) -> bool:
        now = self._now()
        self._tick()
        self._counts[cause] += events
        burst = self._bursts.get(cause)
        if burst is None:
            self._bursts[cause] = _Burst(now, now, now, total=events, detail=detail)
            self._log(f"{self._prefix}{cause}: {detail}")
            return True
        burst.last, burst.detail = now, detail
        burst.unsaid += events
        burst.total += events
        return False

    def _tick(self) -> None:
        now = self._now()
        for cause, burst in list(self._bursts.items()):
            over = now - burst.last >= self._quiet
            if burst.unsaid and (over or now - burst.said >= self._every):
                span = burst.last - burst.started
                self._log(f"{self._prefix}{cause}: {burst.total} in {span:.1f} s, the last: {burst.detail}")
                burst.unsaid, burst.said = 0, now
            if over:
                del self._bursts[cause]

"""Log bursts of events with one cause: every event is counted, and a few lines summarise a burst."""

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
    """Counts events by cause and logs a burst in a few lines: its first event at once, then summaries.

    A burst ends when no event of its cause has occurred for ``quiet`` seconds; a long burst is summarised every
    ``every`` seconds. The methods are thread-safe.

    Args:
        log: function that writes one line.
        now: monotonic clock [s].
        prefix: text at the start of every line.
        quiet: time without an event that ends a burst [s].
        every: interval between the summaries of a long burst [s].
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
        """Number of events so far, by cause."""
        with self._lock:
            return Counter(self._counts)

    @property
    def total(self) -> int:
        """Number of events of all causes."""
        return self.counts.total()

    def note(self, cause: str, detail: str, events: int = 1) -> bool:
        """Count one event or several, and return whether a burst starts with it."""
        with self._lock:
            return self._note(cause, detail, events)

    def tick(self) -> None:
        """Log the summaries that are due; call this about once a second."""
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

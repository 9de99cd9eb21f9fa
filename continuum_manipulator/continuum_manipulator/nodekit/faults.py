"""Messages that a node refuses: counted by cause, and told once per burst."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass


class MessageFault(Exception):
    """A message that a node must not use.

    Args:
        cause: the kind of fault in a few words, the same for all of its kind; it is what is counted.
        detail: what is wrong with this message: the offending value and what is allowed.
    """

    def __init__(self, cause: str, detail: str) -> None:
        self.cause = cause
        self.detail = detail
        super().__init__(f"{cause}: {detail}")


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

    A burst is over when its cause was quiet for ``quiet`` seconds; a long one is summed up every ``every`` seconds.

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
        self._bursts: dict[str, _Burst] = {}
        self.counts: Counter[str] = Counter()

    @property
    def total(self) -> int:
        """Events of all causes."""
        return self.counts.total()

    def note(self, cause: str, detail: str, events: int = 1) -> None:
        """Count an event, or several at once."""
        now = self._now()
        self.tick()
        self.counts[cause] += events
        burst = self._bursts.get(cause)
        if burst is None:
            self._bursts[cause] = _Burst(now, now, now, total=events, detail=detail)
            self._log(f"{self._prefix}{cause}: {detail}")
            return
        burst.last, burst.detail = now, detail
        burst.unsaid += events
        burst.total += events

    def tick(self) -> None:
        """Say what is due; to be called about once a second."""
        now = self._now()
        for cause, burst in list(self._bursts.items()):
            over = now - burst.last >= self._quiet
            if burst.unsaid and (over or now - burst.said >= self._every):
                span = burst.last - burst.started
                self._log(f"{self._prefix}{cause}: {burst.total} in {span:.1f} s, the last: {burst.detail}")
                burst.unsaid, burst.said = 0, now
            if over:
                del self._bursts[cause]

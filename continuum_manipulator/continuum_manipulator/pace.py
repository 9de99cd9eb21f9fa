"""Due instants of a simulation by a clock: none is ever skipped, and late instants make up the lag."""

from __future__ import annotations

from continuum_manipulator.nodekit.stamps import NANOSECONDS


class Pace:
    """Instants [ns] at a rate, starting half a period early, so that a query slightly too early finds its instant due.

    Args:
        rate: instants per second [Hz].
        most: longest time that is returned at once [s], which limits the duration of a simulation batch.
        now: present time of the clock [ns].

    Attributes:
        seen: latest time of the clock so far [ns].
    """

    def __init__(self, rate: float, most: float, now: int) -> None:
        self._rate = rate
        self._most = max(1, int(most * rate))
        self.begin(now)

    def begin(self, now: int) -> None:
        """Restart the count at the time ``now`` [ns]."""
        self.seen = now
        self._first = max(1, now - round(0.5 * NANOSECONDS / self._rate))  # 0 means no stamp
        self._done = 0

    @property
    def last(self) -> int:
        """Instant up to which the simulation is complete [ns]."""
        return self._instant(self._done)

    def due(self, now: int) -> range:
        """Return the numbers of the due instants, for :meth:`reach`."""
        self.seen = max(self.seen, now)
        passed = (now - self._first) * self._rate / NANOSECONDS
        return range(self._done + 1, min(int(passed), self._done + self._most) + 1)

    def reach(self, number: int) -> int:
        """Mark a due instant as simulated, and return its time [ns]."""
        self._done = number
        return self.last

    def lag(self, now: int) -> float:
        """Return the time since the next instant was due [s], 0 if it is not due yet."""
        return max(0, now - self._instant(self._done + 1)) / NANOSECONDS

    def covered(self, now: int) -> float:
        """Return the completely simulated time since the start [s]: the time until ``now`` minus the lag."""
        return self.seconds(now) - self.lag(now)

    def went_back(self, now: int) -> bool:
        """Return whether the clock went back."""
        return now < self.seen

    def seconds(self, instant: int) -> float:
        """Return the time from the start to an instant [s]."""
        return (instant - self._first) / NANOSECONDS

    def _instant(self, number: int) -> int:
        return self._first + round(number * NANOSECONDS / self._rate)

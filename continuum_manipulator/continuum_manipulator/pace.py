"""Which instants of a simulation are due by a clock: none is ever skipped, what is missing is the lag."""

from __future__ import annotations

from continuum_manipulator.nodekit.stamps import NANOSECONDS


class Pace:
    """Instants [ns] at a rate, from half a period before it begins: a look that comes a little early finds its own due.

    Args:
        rate: instants a second [Hz].
        most: seconds of them that are given out at once, so that whoever simulates them is not away for longer.
        now: the clock [ns].

    Attributes:
        seen: the latest time that the clock showed [ns].
    """

    def __init__(self, rate: float, most: float, now: int) -> None:
        self._rate = rate
        self._most = max(1, int(most * rate))
        self.begin(now)

    def begin(self, now: int) -> None:
        """Count anew."""
        self.seen = now
        self._first = max(1, now - round(0.5 * NANOSECONDS / self._rate))  # 0 would be no stamp
        self._done = 0

    @property
    def last(self) -> int:
        """The instant up to which is simulated [ns]."""
        return self._instant(self._done)

    def due(self, now: int) -> range:
        """What is to be simulated now: its numbers, for :meth:`reach`."""
        self.seen = max(self.seen, now)
        passed = (now - self._first) * self._rate / NANOSECONDS
        return range(self._done + 1, min(int(passed), self._done + self._most) + 1)

    def reach(self, number: int) -> int:
        """The instant [ns] of a number that was due is simulated."""
        self._done = number
        return self.last

    def lag(self, now: int) -> float:
        """How long ago the next instant was due [s], 0 where it is yet to come."""
        return max(0, now - self._instant(self._done + 1)) / NANOSECONDS

    def covered(self, now: int) -> float:
        """Time from the beginning in which nothing that was due is missing [s]: up to ``now`` less the lag."""
        return self.seconds(now) - self.lag(now)

    def went_back(self, now: int) -> bool:
        """Whether the clock shows less than it did before."""
        return now < self.seen

    def seconds(self, instant: int) -> float:
        """From the beginning to an instant [s]."""
        return (instant - self._first) / NANOSECONDS

    def _instant(self, number: int) -> int:
        return self._first + round(number * NANOSECONDS / self._rate)

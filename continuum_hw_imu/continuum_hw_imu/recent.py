"""Growth of counts over the last seconds."""

from __future__ import annotations

from collections import deque

RECENT = 5.0
"""Time for which the growth of a count gives a warning [s]."""

SPAN = 3.0
"""Time over which a rate is averaged [s]."""


class Recent:
    """Detects recent growth of several counts, by name. A count that falls has restarted."""

    def __init__(self) -> None:
        self._counts: dict[str, int] = {}
        self._until: dict[str, float] = {}

    def grew(self, name: str, count: int, now: float) -> bool:
        """Record a count; return whether it grew now or within the last :data:`RECENT` seconds."""
        if count > self._counts.get(name, 0):
            self._until[name] = now + RECENT
        self._counts[name] = count
        return now < self._until.get(name, now)


class RateMeter:
    """Growth rate of one count."""

    def __init__(self) -> None:
        self._marks: deque[tuple[float, int]] = deque()

    def rate(self, count: int, now: float) -> float:
        """Record the count; return its growth per second [Hz] over the last seconds, 0 before the second call."""
        if self._marks and count < self._marks[-1][1]:
            self._marks.clear()
        self._marks.append((now, count))
        while len(self._marks) > 2 and now - self._marks[1][0] >= SPAN:
            self._marks.popleft()
        (begin, first), (end, last) = self._marks[0], self._marks[-1]
        return (last - first) / (end - begin) if end > begin else 0.0

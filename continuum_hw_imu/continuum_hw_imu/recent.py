"""Counts over the last seconds: whether they grew, and how fast."""

from __future__ import annotations

from collections import deque

RECENT = 5.0
"""For so long a count that grew is worth a warning [s]."""

SPAN = 3.0
"""Over which a rate is taken [s]."""


class Recent:
    """Which of several counts, by name, grew lately. A count that fell has begun anew."""

    def __init__(self) -> None:
        self._counts: dict[str, int] = {}
        self._until: dict[str, float] = {}

    def grew(self, name: str, count: int, now: float) -> bool:
        """Look at a count; whether it grew now or within the last :data:`RECENT` seconds."""
        if count > self._counts.get(name, 0):
            self._until[name] = now + RECENT
        self._counts[name] = count
        return now < self._until.get(name, now)


class RateMeter:
    """How fast one count grows."""

    def __init__(self) -> None:
        self._marks: deque[tuple[float, int]] = deque()

    def rate(self, count: int, now: float) -> float:
        """Look at the count; what it grew by a second [Hz] over the last seconds, 0 before there are two looks."""
        if self._marks and count < self._marks[-1][1]:
            self._marks.clear()
        self._marks.append((now, count))
        while len(self._marks) > 2 and now - self._marks[1][0] >= SPAN:
            self._marks.popleft()
        (begin, first), (end, last) = self._marks[0], self._marks[-1]
        return (last - first) / (end - begin) if end > begin else 0.0

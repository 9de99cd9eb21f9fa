"""How fast a simulation runs, and what it costs, over the last second or two."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

SPAN = 2.0
"""Seconds looked at."""


class Mark(NamedTuple):
    """Readings [s] at one moment: a clock on the wall, the process's processor time, and how far the simulation is.

    That is the end of the time in which nothing that was due is missing.
    """

    wall: float
    processor: float
    simulated: float


class LoadMeter:
    """Differences over the last :data:`SPAN` seconds; 0 before there are two marks."""

    def __init__(self) -> None:
        self._marks: deque[Mark] = deque()

    def mark(self, mark: Mark) -> None:
        """Note the readings; to be called often."""
        self._marks.append(mark)
        while mark.wall - self._marks[0].wall > SPAN:
            self._marks.popleft()

    def restart(self) -> None:
        """Forget: the simulated time begins anew."""
        self._marks.clear()

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds a second; 1 keeps up with a clock on the wall."""
        return self._slope("simulated")

    @property
    def load(self) -> float:
        """Share of one processor core that the process takes."""
        return self._slope("processor")

    def _slope(self, field: str) -> float:
        if len(self._marks) < 2 or self._marks[-1].wall <= self._marks[0].wall:
            return 0.0
        first, last = self._marks[0], self._marks[-1]
        return (getattr(last, field) - getattr(first, field)) / (last.wall - first.wall)

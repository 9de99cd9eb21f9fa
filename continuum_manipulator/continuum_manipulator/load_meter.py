"""Speed and processor load of a simulation over the last second or two."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

SPAN = 2.0
"""Duration over which the averages are taken [s]."""


class Mark(NamedTuple):
    """Readings [s] at one moment: wall clock, processor time of the process, and progress of the simulation.

    The progress is the simulated time up to which all due instants are complete.
    """

    wall: float
    processor: float
    simulated: float


class LoadMeter:
    """Differences over the last :data:`SPAN` seconds; 0 before there are two marks."""

    def __init__(self) -> None:
        self._marks: deque[Mark] = deque()

    def mark(self, mark: Mark) -> None:
        """Record the readings; call this often."""
        self._marks.append(mark)
        while mark.wall - self._marks[0].wall > SPAN:
            self._marks.popleft()

    def restart(self) -> None:
        """Discard the readings, because the simulated time restarts."""
        self._marks.clear()

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds per second; 1 is real time."""
        return self._slope("simulated")

    @property
    def load(self) -> float:
        """Fraction of one processor core that the process uses."""
        return self._slope("processor")

    def _slope(self, field: str) -> float:
        if len(self._marks) < 2 or self._marks[-1].wall <= self._marks[0].wall:
            return 0.0
        first, last = self._marks[0], self._marks[-1]
        return (getattr(last, field) - getattr(first, field)) / (last.wall - first.wall)

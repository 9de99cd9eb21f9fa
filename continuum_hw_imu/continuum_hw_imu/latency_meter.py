"""How long frames take through a process: a quantile of the latest ones."""

from __future__ import annotations

from collections import deque

import numpy as np

KEPT = 1800
"""Frames looked at: 30 s at 60 Hz."""


class LatencyMeter:
    """The latest latencies [s], and the largest ever."""

    def __init__(self) -> None:
        self._latest: deque[float] = deque(maxlen=KEPT)
        self.largest = 0.0

    def note(self, latency: float) -> None:
        """One frame took ``latency`` [s]."""
        self._latest.append(latency)
        self.largest = max(self.largest, latency)

    def quantile(self, part: float) -> float:
        """Latency that ``part`` (0 to 1) of the latest frames do not exceed [s]; 0 before the first."""
        latest = self._latest.copy()  # the reading thread goes on
        return float(np.quantile(latest, part)) if latest else 0.0

"""Latency of frames through a process: quantiles of the latest frames."""

from __future__ import annotations

from collections import deque

import numpy as np

KEPT = 1800
"""Number of evaluated frames: 30 s at 60 Hz."""


class LatencyMeter:
    """The latest latencies [s], and the largest one since the start."""

    def __init__(self) -> None:
        self._latest: deque[float] = deque(maxlen=KEPT)
        self.largest = 0.0

    def note(self, latency: float) -> None:
        """Record the ``latency`` [s] of one frame."""
        self._latest.append(latency)
        self.largest = max(self.largest, latency)

    def quantile(self, part: float) -> float:
        """Return the latency [s] that ``part`` (0 to 1) of the latest frames do not exceed; 0 before the first."""
        latest = self._latest.copy()  # the reading thread continues to write
        return float(np.quantile(latest, part)) if latest else 0.0

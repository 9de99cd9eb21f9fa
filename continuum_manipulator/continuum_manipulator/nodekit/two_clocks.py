"""Read two clocks at the same instant, although the process may be interrupted between the two readings."""

from __future__ import annotations

from collections.abc import Callable

CLOSE = 5e-5
"""Time within which both clocks are read, unless the process is interrupted repeatedly [s]."""

TRIES = 5


def read_together(steady: Callable[[], float], other: Callable[[], int]) -> tuple[float, int]:
    """Return the readings of a monotonic clock [s] and of another clock [ns] at the same instant.

    The result is the closest of at most `TRIES` pairs of readings.
    """
    readings: list[tuple[float, float, int]] = []
    while len(readings) < TRIES and not (readings and readings[-1][0] <= CLOSE):
        before, shown, after = steady(), other(), steady()
        readings.append((after - before, 0.5 * (before + after), shown))
    _, instant, shown = min(readings)
    return instant, shown

"""One instant by two clocks, on a machine that may take the processor away between reading the one and the other."""

from __future__ import annotations

from collections.abc import Callable

CLOSE = 5e-5
"""Time within which both are read, unless the machine takes the processor away again and again [s]."""

TRIES = 5


def read_together(steady: Callable[[], float], other: Callable[[], int]) -> tuple[float, int]:
    """What a clock that is never set shows [s], and what another one shows [ns] at the same instant.

    The closest of at most `TRIES` readings.
    """
    readings: list[tuple[float, float, int]] = []
    while len(readings) < TRIES and not (readings and readings[-1][0] <= CLOSE):
        before, shown, after = steady(), other(), steady()
        readings.append((after - before, 0.5 * (before + after), shown))
    _, instant, shown = min(readings)
    return instant, shown

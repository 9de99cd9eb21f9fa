"""Time at which a stream is complete again after a fault."""

from __future__ import annotations

from collections.abc import Sequence

from tools.benchmarks.link.latency_probe import Sample, State

WHOLE = 0.5
"""A stream counts as complete from an instant on if nothing is missing for this time [s]."""

LARGEST_STEP = 1.5
"""Largest distance of consecutive stamps in periods; a larger one means a missing message."""


def good_again(received: Sequence[Sample | State], back: float, period: float) -> float | None:
    """Return the time from ``back`` to the arrival of the first message without later gaps [s]; None if there is none.

    Args:
        received: messages of one topic, in the order of arrival.
        back: time from which the link is intact; messages with earlier stamps do not count.
        period: time between two messages [s].
    """
    later = [one for one in received if one.stamp >= back]
    first = 0
    for at in range(1, len(later)):
        step = later[at].stamp - later[at - 1].stamp
        if step > LARGEST_STEP * period:
            first = at
        elif later[at].stamp - later[first].stamp >= WHOLE:
            return max(0.0, later[first].received - back)
    return None

"""When a stream is whole again after a fault."""

from __future__ import annotations

from collections.abc import Sequence

from tools.benchmarks.link.latency_probe import Sample, State

WHOLE = 0.5
"""A stream is good from an instant on if nothing is missing in so long a stretch from there [s]."""

LARGEST_STEP = 1.5
"""From stamp to stamp, of the period; more means that one is missing."""


def good_again(received: Sequence[Sample | State], back: float, period: float) -> float | None:
    """Time from ``back`` until the first message came of a stretch without gaps [s]; None if there is no such stretch.

    Args:
        heard: of one topic, in the order of arrival.
        back: instant from which on the link is sound; messages that tell of earlier instants do not count.
        period: between two messages [s].
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

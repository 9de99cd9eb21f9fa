"""When an arm rested in a recording."""

from __future__ import annotations

import numpy as np

from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.stillness import SHORTEST_REST, unrest

_STEP = SHORTEST_REST / 4


def rests(recording: ImuRecording) -> list[tuple[float, float]]:
    """Begin and end of every time at rest of at least `SHORTEST_REST`, as far as windows of that length tell [s]."""
    found: list[tuple[float, float]] = []
    starts = np.arange(recording.times[0], recording.times[-1] - SHORTEST_REST, _STEP)
    for start in map(float, starts):
        end = start + SHORTEST_REST + 1e-9
        if unrest(recording.part(start - 1e-9, end + _period(recording))):
            continue
        if found and start <= found[-1][1]:
            found[-1] = (found[-1][0], end)
        else:
            found.append((start, end))
    return found


def _period(recording: ImuRecording) -> float:
    return float(np.median(np.diff(recording.times)))

"""When an arm rested in a recording."""

from __future__ import annotations

import numpy as np

from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.stillness import SHORTEST_REST, unrest

_STEP = SHORTEST_REST / 4


def rests(recording: ImuRecording) -> list[tuple[float, float]]:
    """Begin and end of every time at rest, found by windows of `SHORTEST_REST` [s]; what creeps is cut into several."""
    found: list[tuple[float, float]] = []
    window = SHORTEST_REST + 2 * float(np.median(np.diff(recording.times)))
    for start in map(float, np.arange(recording.times[0], recording.times[-1] - window, _STEP)):
        end = start + window
        if unrest(recording.part(start, end)):
            continue
        if found and start < found[-1][1]:
            if not unrest(recording.part(found[-1][0], end)):
                found[-1] = (found[-1][0], end)
        else:
            found.append((start, end))
    return found

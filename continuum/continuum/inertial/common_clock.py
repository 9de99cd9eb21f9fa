"""Clocks of synchronised Xsens DOT sensors put on one axis of time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.errors import MeasurementError
from continuum.inertial.dot_export import WRAP, DotExport
from continuum.inertial.time_grid import Stream

_FARTHEST = 600.0  # s between the starts of recordings of one test


def on_one_clock(exports: Sequence[DotExport]) -> list[Stream]:
    """Streams with times from the earliest start on [s]; sensors that were synchronised share their clock's origin.

    Where the clock began again between the starts of two recordings, the later one counts on.

    Raises:
        MeasurementError: starts so far apart that the sensors cannot have been synchronised.
    """
    first = exports[0].ticks[0]
    # of each start from the first sensor's, within half a wrap
    starts = [int((export.ticks[0] - first + WRAP // 2) % WRAP - WRAP // 2) for export in exports]
    earliest = min(starts)
    late = (max(starts) - earliest) / 1e6
    if late > _FARTHEST:
        names = exports[int(np.argmin(starts))].name, exports[int(np.argmax(starts))].name
        raise MeasurementError(
            f"{names[1]} begins {late:.0f} s after {names[0]} by the sensors' clocks: not synchronised, or another test"
        )
    return [
        Stream(
            export.name,
            (export.ticks - export.ticks[0] + start - earliest) / 1e6,
            export.rates,
            export.forces,
            export.clipped,
        )
        for export, start in zip(exports, starts, strict=True)
    ]

"""What a slider says, within its limits: a browser may send any number, and one that is being typed; and its end."""

from __future__ import annotations

import math

import viser


def end_in_degrees(limit: float) -> float:
    """The largest tenth of a degree that is not beyond ``limit`` [rad]: an end that can be read."""
    tenths = round(10.0 * math.degrees(limit))
    return (tenths if math.radians(tenths / 10.0) <= limit else tenths - 1) / 10.0


def value_within(slider: viser.GuiSliderHandle[float]) -> float:
    """The slider's value, the nearest limit where it is beyond, the lower one where it is no number."""
    value = float(slider.value)
    return min(max(value, slider.min), slider.max) if math.isfinite(value) else slider.min

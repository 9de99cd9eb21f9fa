"""Slider values clipped to their limits, because a browser may send any number, and limits as readable numbers."""

from __future__ import annotations

import math

import viser


def end_in_degrees(limit: float) -> float:
    """Return ``limit`` [rad] in degrees, rounded down to a tenth."""
    tenths = round(10.0 * math.degrees(limit))
    return (tenths if math.radians(tenths / 10.0) <= limit else tenths - 1) / 10.0


def value_within(slider: viser.GuiSliderHandle[float]) -> float:
    """Return the value of a slider, clipped to its limits; the lower limit if it is not a finite number."""
    value = float(slider.value)
    return min(max(value, slider.min), slider.max) if math.isfinite(value) else slider.min

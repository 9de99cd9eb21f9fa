"""Corners rounded within a stated width, for fits that differentiate the motion by an effect's parameters."""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers


def rounded_size(x: Numbers, width: float) -> Numbers:
    """|x|, never below ``width``: sqrt(x^2 + width^2), in the unit of both."""
    return np.sqrt(x * x + width * width)


def rounded_part(x: Numbers, width: float) -> Numbers:
    """The positive part of x, half of ``width`` at 0: (x + sqrt(x^2 + width^2)) / 2."""
    return (x + rounded_size(x, width)) / 2

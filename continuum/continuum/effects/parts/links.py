"""Vectors in the plane that links carry, (n, 2) in (x, z): where they point, and what they add up to."""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers


def along(angle: Numbers) -> Numbers:
    """Unit vector along each angle from the straight arm, (n, 2) of (n,) [rad]."""
    return np.stack([np.sin(angle), np.cos(angle)], axis=1)


def across(angle: Numbers) -> Numbers:
    """Unit vector across it, towards growing angles: the slope of `along`, (n, 2)."""
    return np.stack([np.cos(angle), -np.sin(angle)], axis=1)


def sum_before(vectors: Numbers) -> Numbers:
    """Of every link, the sum of the vectors of those before it, (n, 2)."""
    return np.cumsum(vectors, axis=0) - vectors

"""Joint bend limits as the solvers keep them: theta of a section at most its ``bend_limit``."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.configuration import bend

_AT_LIMIT = 1e-9


def limits_of(arm: Arm) -> Array:
    """Bend limits (n_sections,) [rad]."""
    return np.array([section.bend_limit for section in arm.sections])


def within_limits(w: Array, arm: Arm) -> Array:
    """``w`` (n_sections, 2) [rad] with every section that is bent too far brought back to its limit."""
    theta = bend(w)
    limit = limits_of(arm)
    scale = np.where(theta > limit, limit / np.where(theta > 0.0, theta, 1.0), 1.0)
    return w * scale[:, None]


def at_limit(w: Array, arm: Arm) -> NDArray[np.bool_]:
    """Which sections are bent to their limit, (n_sections,) bool, at ``w`` (n_sections, 2) [rad]."""
    return bend(w) >= limits_of(arm) - _AT_LIMIT


def without_outward(jacobian: Array, w: Array, step: Array, arm: Arm) -> Array:
    """``jacobian`` (m, 2 n_sections) without the columns' part that would bend a section beyond its limit.

    A section is held where it is at its limit and ``step`` (n_sections, 2) would bend it further; it may still turn.
    """
    outward = np.sum(w * step, axis=-1) > 0.0
    held = jacobian.copy()
    for i in np.flatnonzero(at_limit(w, arm) & outward):
        radial = w[i] / bend(w[i])
        columns = held[:, 2 * i : 2 * i + 2]
        held[:, 2 * i : 2 * i + 2] = columns - np.outer(columns @ radial, radial)
    return held

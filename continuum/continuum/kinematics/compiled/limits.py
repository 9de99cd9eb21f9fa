"""Bend limits in the compiled search: sections at their limit slide along it or move back, but do not exceed it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.equations import compiled

AT_LIMIT = 1.0 - 1e-9


@compiled
def pull_within(arm: ArmArrays, w: Array) -> None:
    """Reduce the bend of every section beyond its limit to that limit."""
    for i in range(len(arm.b)):
        theta = math.hypot(w[2 * i], w[2 * i + 1])
        if theta > arm.bend_limit[i]:
            scale = arm.bend_limit[i] / theta
            w[2 * i] *= scale
            w[2 * i + 1] *= scale


@compiled
def is_within(w: Array, limits: Array) -> bool:
    """Return whether all sections of ``w`` (2 n_sections,) [rad] are within ``limits`` (n_sections,) [rad]."""
    inside = True
    for i in range(len(limits)):
        inside = inside and math.hypot(w[2 * i], w[2 * i + 1]) <= limits[i]
    return inside


@compiled
def hold_outward(
    arm: ArmArrays, w: Array, step: Array, held: NDArray[np.bool_], jacobian: Array, n_rows: int, reach: float
) -> bool:
    """Remove from ``jacobian`` the components that bend a section beyond its limit; return whether anything changed.

    A section becomes held in ``held`` (n_sections,) if ``step`` points outward and the section is at its limit or would
    reach it after ``reach`` times ``step``.
    """
    changed = False
    for i in range(len(arm.b)):
        u, v = w[2 * i], w[2 * i + 1]
        theta = math.hypot(u, v)
        outward = u * step[2 * i] + v * step[2 * i + 1]
        if held[i] or outward <= 0.0 or theta * theta + reach * outward < theta * AT_LIMIT * arm.bend_limit[i]:
            continue
        held[i] = True
        changed = True
        for r in range(n_rows):
            _stop_radial_pair(u / theta, v / theta, jacobian[r], i)
    return changed


@compiled
def stop_radial(w: Array, held: NDArray[np.bool_], rate: Array) -> None:
    """Remove from ``rate`` (2 n_sections,) the components that bend or unbend the held sections."""
    for i in range(len(held)):
        if held[i]:
            theta = math.hypot(w[2 * i], w[2 * i + 1])
            _stop_radial_pair(w[2 * i] / theta, w[2 * i + 1] / theta, rate, i)


@compiled
def _stop_radial_pair(u: float, v: float, row: Array, i: int) -> None:
    """Remove the component along the unit vector (u, v) from section ``i``'s pair in ``row``."""
    radial = row[2 * i] * u + row[2 * i + 1] * v
    row[2 * i] -= radial * u
    row[2 * i + 1] -= radial * v

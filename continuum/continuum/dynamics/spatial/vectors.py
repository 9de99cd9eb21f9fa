"""Spatial vectors about the world's origin: motions (omega, v_O), forces (n_O, f), and inertias (Featherstone 2008).

All bodies share one frame, so that no transform between frames is needed: velocities add up along the chain. An
inertia has ten numbers: mass, first moment m c (3), and the moments about the origin xx, xy, xz, yy, yz, zz.
"""

from __future__ import annotations

from continuum.arrays import Array
from continuum.dynamics.spatial.compiling import inner


@inner
def motion_cross_motion(v: Array, m: Array, out: Array) -> None:
    """out = v x m, the rate of a motion ``m`` (6,) that is carried along with ``v`` (6,)."""
    out[0] = v[1] * m[2] - v[2] * m[1]
    out[1] = v[2] * m[0] - v[0] * m[2]
    out[2] = v[0] * m[1] - v[1] * m[0]
    out[3] = v[1] * m[5] - v[2] * m[4] + v[4] * m[2] - v[5] * m[1]
    out[4] = v[2] * m[3] - v[0] * m[5] + v[5] * m[0] - v[3] * m[2]
    out[5] = v[0] * m[4] - v[1] * m[3] + v[3] * m[1] - v[4] * m[0]


@inner
def motion_cross_force(v: Array, f: Array, out: Array) -> None:
    """out = v x* f, the rate of a force ``f`` (6,) that is carried along with ``v`` (6,)."""
    out[0] = v[1] * f[2] - v[2] * f[1] + v[4] * f[5] - v[5] * f[4]
    out[1] = v[2] * f[0] - v[0] * f[2] + v[5] * f[3] - v[3] * f[5]
    out[2] = v[0] * f[1] - v[1] * f[0] + v[3] * f[4] - v[4] * f[3]
    out[3] = v[1] * f[5] - v[2] * f[4]
    out[4] = v[2] * f[3] - v[0] * f[5]
    out[5] = v[0] * f[4] - v[1] * f[3]


@inner
def inertia_times(inertia: Array, v: Array, out: Array) -> None:
    """out = I v, the momentum (6,) of an inertia (10,) at a motion ``v`` (6,)."""
    m, cx, cy, cz = inertia[0], inertia[1], inertia[2], inertia[3]
    out[0] = inertia[4] * v[0] + inertia[5] * v[1] + inertia[6] * v[2] + cy * v[5] - cz * v[4]
    out[1] = inertia[5] * v[0] + inertia[7] * v[1] + inertia[8] * v[2] + cz * v[3] - cx * v[5]
    out[2] = inertia[6] * v[0] + inertia[8] * v[1] + inertia[9] * v[2] + cx * v[4] - cy * v[3]
    out[3] = m * v[3] + v[1] * cz - v[2] * cy
    out[4] = m * v[4] + v[2] * cx - v[0] * cz
    out[5] = m * v[5] + v[0] * cy - v[1] * cx


@inner
def dot(a: Array, b: Array) -> float:
    """Power of a force at a motion, (6,) each."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5]  # type: ignore[no-any-return]

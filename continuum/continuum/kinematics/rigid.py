"""The rotations and homogeneous transforms that the chain of sections needs.

A matrix may also be the tuple of its entries, row by row. Each entry may be a float or an array, so that one formula
serves both whole trajectories and the compiled solver.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from continuum.arrays import Array

Entries3 = tuple[Any, Any, Any]
Entries9 = tuple[Any, Any, Any, Any, Any, Any, Any, Any, Any]

IDENTITY: Entries9 = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def rotated(r: Entries9, p: Entries3) -> Entries3:
    """The vector ``p`` rotated by the matrix ``r``."""
    return (
        r[0] * p[0] + r[1] * p[1] + r[2] * p[2],
        r[3] * p[0] + r[4] * p[1] + r[5] * p[2],
        r[6] * p[0] + r[7] * p[1] + r[8] * p[2],
    )


def turned_about_z(r: Entries9, c: Any, s: Any) -> Entries9:
    """``r`` times the rotation about z whose angle has the cosine ``c`` and the sine ``s``."""
    return (
        r[0] * c + r[1] * s, r[1] * c - r[0] * s, r[2],
        r[3] * c + r[4] * s, r[4] * c - r[3] * s, r[5],
        r[6] * c + r[7] * s, r[7] * c - r[6] * s, r[8],
    )  # fmt: skip


def product(r: Entries9, m: Entries9) -> Entries9:
    """The matrix product ``r m``."""
    x = rotated(r, (m[0], m[3], m[6]))
    y = rotated(r, (m[1], m[4], m[7]))
    z = rotated(r, (m[2], m[5], m[8]))
    return (x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2])


def transposed(r: Entries9) -> Entries9:
    """The transpose, which for a rotation is the inverse."""
    return (r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8])


def cross(a: Entries3, b: Entries3) -> Entries3:
    """The vector product a x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def vector(entries: Entries3) -> Array:
    """Array (..., 3) of three entries (...)."""
    return np.stack(np.broadcast_arrays(*entries), axis=-1)


def matrix(entries: Entries9) -> Array:
    """Array (..., 3, 3) of nine entries (...)."""
    flat = np.stack(np.broadcast_arrays(*entries), axis=-1)
    return flat.reshape((*flat.shape[:-1], 3, 3))


def entries_of(m: Array) -> Entries9:
    """The nine entries (...) of an array (..., 3, 3)."""
    return (
        m[..., 0, 0], m[..., 0, 1], m[..., 0, 2],
        m[..., 1, 0], m[..., 1, 1], m[..., 1, 2],
        m[..., 2, 0], m[..., 2, 1], m[..., 2, 2],
    )  # fmt: skip


def transform(rotation: Array, position: Array) -> Array:
    """Homogeneous transform (..., 4, 4) of a rotation (..., 3, 3) and a position (..., 3) [m]."""
    result = np.zeros((*np.broadcast_shapes(rotation.shape[:-2], position.shape[:-1]), 4, 4))
    result[..., :3, :3] = rotation
    result[..., :3, 3] = position
    result[..., 3, 3] = 1.0
    return result

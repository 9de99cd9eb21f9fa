"""Rotations and homogeneous transforms, as far as the chain of sections needs them."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array


def transform(rotation: Array, position: Array) -> Array:
    """Homogeneous transform (..., 4, 4) of a rotation (..., 3, 3) and a position (..., 3) [m]."""
    result = np.zeros((*np.broadcast_shapes(rotation.shape[:-2], position.shape[:-1]), 4, 4))
    result[..., :3, :3] = rotation
    result[..., :3, 3] = position
    result[..., 3, 3] = 1.0
    return result


def rotation_about_z(angle: float) -> Array:
    """Rotation matrix (3, 3) about z by ``angle`` [rad]."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def turn_about_z(angle: float) -> Array:
    """Homogeneous transform (4, 4) that turns about z by ``angle`` [rad]."""
    return transform(rotation_about_z(angle), np.zeros(3))

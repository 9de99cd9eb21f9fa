"""Rotation from one orientation to another about one fixed axis (KDL: RotationalInterpolation_SingleAxis)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from continuum.arrays import Array
from trajectory_generator.checked_arrays import finite_array, rotation_matrices

HALF_TURN_MARGIN = 1e-6
"""Distance from half a turn within which both directions count as equally short [rad]."""


@dataclass(frozen=True, eq=False)
class Turn:
    """Rotations, one per row, each about an axis that is fixed both in space and in the rotating frame.

    Attributes:
        start: orientation at the start, in the base frame (..., 3, 3).
        axis: unit vector in the frame ``start`` (..., 3).
        angle: total angle (...) [rad], 0 to pi (half a turn: up to ``HALF_TURN_MARGIN`` more).
    """

    start: Array
    axis: Array
    angle: Array

    @classmethod
    def between(cls, start: Array, end: Array) -> Turn:
        """Return the shortest rotations from ``start`` to ``end``, both (n, 3, 3).

        Half a turn is equally short in both directions; as in KDL, the axis whose largest component is positive is
        chosen.
        """
        vector = Rotation.from_matrix(start.transpose(0, 2, 1) @ end).as_rotvec()
        angle = np.linalg.norm(vector, axis=1)
        turns = angle > 0
        axis = np.where(turns[:, None], vector, [0.0, 0.0, 1.0]) / np.where(turns, angle, 1.0)[:, None]
        largest = np.take_along_axis(axis, np.abs(axis).argmax(axis=1)[:, None], axis=1)[:, 0]
        other_way = (angle > np.pi - HALF_TURN_MARGIN) & (largest < 0)
        return cls(start, np.where(other_way[:, None], -axis, axis), np.where(other_way, 2 * np.pi - angle, angle))

    @classmethod
    def between_two(cls, start_rotation: ArrayLike, end_rotation: ArrayLike) -> Turn:
        """Return the shortest rotation between two orientations (3, 3), as a single row.

        Raises:
            InvalidValueError: one of them is not a rotation matrix.
        """
        given = {"start_rotation": start_rotation, "end_rotation": end_rotation}
        start, end = (
            rotation_matrices(name, finite_array(name, matrix, (3, 3))[None]) for name, matrix in given.items()
        )
        return cls.between(start, end)

    def take(self, rows: np.ndarray | slice) -> Turn:
        """Return the rotations of ``rows``, in that order and shape."""
        return Turn(self.start[rows], self.axis[rows], self.angle[rows])

    def part(self, begin: Array, end: Array) -> Turn:
        """Return the parts of the rotations from the fraction ``begin`` (...) of the angle to ``end`` (...)."""
        return Turn(self.orientation(begin), self.axis, self.angle * (end - begin))

    @classmethod
    def joined(cls, parts: Sequence[Turn]) -> Turn:
        """Concatenate the rotations of ``parts``."""
        return cls(
            np.concatenate([part.start for part in parts]),
            np.concatenate([part.axis for part in parts]),
            np.concatenate([part.angle for part in parts]),
        )

    def orientation(self, fraction: Array) -> Array:
        """Return the orientation (..., 3, 3) at ``fraction`` (...) of the angle: start exp(fraction angle [axis]x)."""
        return self.start @ rotation_about(self.axis, fraction * self.angle)

    def rate(self, fraction_rate: Array) -> Array:
        """Return the angular velocity (..., 3) in the base frame [rad/s] for ``fraction_rate`` (...) [1/s]."""
        axis_in_base: Array = np.einsum("...ij,...j->...i", self.start, self.axis)
        return axis_in_base * (fraction_rate * self.angle)[..., None]


def rotation_about(axis: Array, angle: Array) -> Array:
    """Rotation matrices (..., 3, 3) by ``angle`` (...) [rad] about the unit vectors ``axis`` (..., 3) (Rodrigues)."""
    x, y, z = np.moveaxis(axis, -1, 0)
    zero = np.zeros_like(x)
    cross: Array = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*axis.shape, 3)
    sine, cosine = np.sin(angle)[..., None, None], np.cos(angle)[..., None, None]
    return np.eye(3) + sine * cross + (1 - cosine) * (cross @ cross)


def quaternions(matrices: Array) -> Array:
    """Return unit quaternions x, y, z, w (..., 4) with w >= 0 of rotation matrices (..., 3, 3)."""
    flat: Array = Rotation.from_matrix(matrices.reshape(-1, 3, 3)).as_quat()
    return np.where(flat[:, 3:] < 0, -flat, flat).reshape(*matrices.shape[:-2], 4)

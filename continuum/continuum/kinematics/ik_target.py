"""Targets of the arm's tip: position, position and direction, or full pose; one target or many."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.number_checks import finite_of_shape

POSITION, DIRECTION, POSE = 3, 5, 6
"""Kinds of target, by the number of conditions that they set."""


_ROUNDING = 1e-15
_KINDS = {3: POSITION, 6: DIRECTION, 12: POSE}


class Targets:
    """Targets of one kind. They copy their arguments and are immutable.

    Args:
        positions: (n, 3) [m] in ``base_link``.
        directions: directions of the tip's z axis, (n, 3), of any nonzero length; None leaves it free.
        rotations: rotations of the tip frame in ``base_link``, (n, 3, 3), or None. Excludes ``directions``.

    Raises:
        InvalidValueError: an argument has the wrong shape or is not finite, a direction has length zero, a matrix is
            not a rotation, or both directions and rotations are given.
    """

    __slots__ = ("_rows",)

    def __init__(
        self, positions: ArrayLike, directions: ArrayLike | None = None, rotations: ArrayLike | None = None
    ) -> None:
        points = finite_of_shape("positions", positions, (-1, 3))
        n = len(points)
        self._rows = points
        _refuse_both(directions, rotations)
        if directions is not None:
            self._rows = _side_by_side(points, _unit_vectors(finite_of_shape("directions", directions, (n, 3))))
        elif rotations is not None:
            self._rows = _side_by_side(
                points, _orthonormal(finite_of_shape("rotations", rotations, (n, 3, 3))).reshape(n, 9)
            )

    def __len__(self) -> int:
        return len(self._rows)

    @property
    def rows(self) -> Array:
        """Targets as rows (n, 3), (n, 6) or (n, 12): positions, followed by directions or rotations row by row."""
        return self._rows

    @property
    def kind(self) -> int:
        """POSITION, DIRECTION or POSE."""
        return _KINDS[self._rows.shape[1]]

    @property
    def positions(self) -> Array:
        """Positions (n, 3) [m]."""
        return self._rows[:, :3]

    @property
    def directions(self) -> Array | None:
        """Unit vectors (n, 3), or None if the targets set no direction."""
        return self._rows[:, 3:] if self.kind == DIRECTION else None

    @property
    def rotations(self) -> Array | None:
        """Rotation matrices (n, 3, 3), or None if the targets set no rotation."""
        return self._rows[:, 3:].reshape(-1, 3, 3) if self.kind == POSE else None


class Target(Targets):
    """A single target.

    Args:
        position: (3,) [m] in ``base_link``.
        direction: direction of the tip's z axis, (3,); None leaves it free.
        rotation: rotation of the tip frame in ``base_link``, (3, 3), or None. Excludes ``direction``.

    Raises:
        InvalidValueError: as for :class:`Targets`.
    """

    __slots__ = ()

    def __init__(
        self, position: ArrayLike, direction: ArrayLike | None = None, rotation: ArrayLike | None = None
    ) -> None:
        self._rows = finite_of_shape("position", position, (3,)).reshape(1, 3)
        _refuse_both(direction, rotation)
        if direction is not None:
            self._rows = _side_by_side(self._rows, _unit_vectors(finite_of_shape("direction", direction, (3,))[None]))
        elif rotation is not None:
            self._rows = _side_by_side(
                self._rows, _orthonormal(finite_of_shape("rotation", rotation, (3, 3))).reshape(1, 9)
            )

    @property
    def position(self) -> Array:
        """Position (3,) [m]."""
        position: Array = self._rows[0, :3]
        return position

    @property
    def direction(self) -> Array | None:
        """Unit vector (3,), or None if the target sets no direction."""
        return self._rows[0, 3:] if self.kind == DIRECTION else None


def configuration_of(arm: Arm, start: ArrayLike | None) -> Array:
    """``start`` as a new array (n_sections, 2) [rad], or the straight arm.

    Raises:
        InvalidValueError: wrong shape or not finite.
    """
    return np.zeros((arm.n_sections, 2)) if start is None else finite_of_shape("start", start, (arm.n_sections, 2))


def _refuse_both(directions: object, rotations: object) -> None:
    if directions is not None and rotations is not None:
        raise InvalidValueError("directions", directions, "None with rotations, which set the directions too")


def _side_by_side(points: Array, more: Array) -> Array:
    rows = np.empty((len(points), 3 + more.shape[-1]))
    rows[:, :3], rows[:, 3:] = points, more
    return rows


def _unit_vectors(directions: Array) -> Array:
    """``directions`` (n, 3), each divided by its length."""
    return np.array([_unit_vector(*direction) for direction in directions.tolist()]).reshape(-1, 3)


def _unit_vector(x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return the vector divided by its length; a unit vector is returned unchanged, to the last digit."""
    largest = max(abs(x), abs(y), abs(z))
    if largest == 0.0:
        raise InvalidValueError("direction", [x, y, z], "three finite numbers, not all zero")
    if not 1e-100 < largest < 1e100:  # squares would leave the range of floats
        x, y, z = x / largest, y / largest, z / largest
    length = math.hypot(x, y, z)
    return (x, y, z) if abs(length - 1.0) < _ROUNDING else (x / length, y / length, z / length)


def _orthonormal(rotations: Array) -> Array:
    """Return ``rotations`` (..., 3, 3) after checking that they are rotation matrices."""
    worst = np.abs(np.swapaxes(rotations, -1, -2) @ rotations - np.eye(3)).max(axis=(-2, -1))
    wrong = (worst > 1e-6) | (np.linalg.det(rotations) < 0.0)
    if np.any(wrong):
        first = rotations.reshape(-1, 3, 3)[np.argmax(wrong)]
        raise InvalidValueError("rotation", first.tolist(), "a right-handed rotation matrix, to 1e-6")
    return rotations

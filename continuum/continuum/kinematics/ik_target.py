"""Where the tip of an arm shall be: position, position and direction, or full pose; one target or many."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.errors import InvalidValueError

POSITION, DIRECTION, POSE = 3, 5, 6
"""Kinds of target, by the number of conditions that they set."""


@dataclass(frozen=True, eq=False)
class Targets:
    """Targets of one kind.

    Attributes:
        positions: (n, 3) [m] in ``base_link``.
        directions: where the tip's z axis shall point, (n, 3), of any length but zero; None where it is free.
        rotations: of the tip frame in ``base_link``, (n, 3, 3), or None. Excludes ``directions``.

    Raises:
        InvalidValueError: wrong shape, not finite, a direction of length zero, no rotation, or both given.
    """

    positions: Array
    directions: Array | None = None
    rotations: Array | None = None

    def __post_init__(self) -> None:
        positions = finite("positions", self.positions, (-1, 3))
        object.__setattr__(self, "positions", positions)
        if self.directions is not None and self.rotations is not None:
            raise InvalidValueError("directions", self.directions, "none beside rotations, which have them already")
        if self.directions is not None:
            directions = finite("directions", self.directions, (len(positions), 3))
            object.__setattr__(self, "directions", _unit_vectors(directions))
        if self.rotations is not None:
            rotations = finite("rotations", self.rotations, (len(positions), 3, 3))
            object.__setattr__(self, "rotations", _orthonormal(rotations))

    def __len__(self) -> int:
        return len(self.positions)

    @property
    def kind(self) -> int:
        """POSITION, DIRECTION or POSE."""
        return POSE if self.rotations is not None else POSITION if self.directions is None else DIRECTION

    @cached_property
    def axes(self) -> Array:
        """Matrices (n, 3, 3) that hold what is wanted: the rotations, or the directions as their third columns."""
        if self.rotations is not None:
            return self.rotations
        axes = np.zeros((len(self), 3, 3))
        axes[:, :, 2] = (0.0, 0.0, 1.0) if self.directions is None else self.directions
        return axes


class Target(Targets):
    """A single target.

    Args:
        position: (3,) [m] in ``base_link``.
        direction: where the tip's z axis shall point, (3,); None where it is free.
        rotation: of the tip frame in ``base_link``, (3, 3), or None. Excludes ``direction``.

    Raises:
        InvalidValueError: as for :class:`Targets`.
    """

    def __init__(
        self, position: ArrayLike, direction: ArrayLike | None = None, rotation: ArrayLike | None = None
    ) -> None:
        super().__init__(
            finite("position", position, (3,))[None],
            None if direction is None else finite("direction", direction, (3,))[None],
            None if rotation is None else finite("rotation", rotation, (3, 3))[None],
        )

    @property
    def position(self) -> Array:
        """(3,) [m]."""
        position: Array = self.positions[0]
        return position

    @property
    def direction(self) -> Array | None:
        """Unit vector (3,), or None where it is free."""
        return None if self.directions is None else self.directions[0]


def configuration_of(arm: Arm, start: ArrayLike | None) -> Array:
    """``start`` as a new array (n_sections, 2) [rad], or the straight arm.

    Raises:
        InvalidValueError: wrong shape or not finite.
    """
    return np.zeros((arm.n_sections, 2)) if start is None else finite("start", start, (arm.n_sections, 2))


def finite(name: str, value: object, shape: tuple[int, ...]) -> Array:
    """``value`` as a new array of ``shape``, -1 for any number, all finite, in C order as compiled code expects it.

    Raises:
        InvalidValueError: it is none.
    """
    words = " x ".join("n" if count < 0 else str(count) for count in shape)
    allowed = "three finite numbers" if shape == (3,) else f"finite numbers, {words}"
    try:
        array = np.array(value, dtype=float, order="C")
    except (TypeError, ValueError, OverflowError):
        raise InvalidValueError(name, value, allowed) from None
    fits = len(array.shape) == len(shape) and all(b in (-1, a) for a, b in zip(array.shape, shape, strict=True))
    if not fits or not np.isfinite(array).all():
        raise InvalidValueError(name, array.tolist(), allowed)
    return array


def _unit_vectors(directions: Array) -> Array:
    lengths = np.linalg.norm(directions, axis=-1, keepdims=True)
    if np.any(lengths < 1e-12):
        k = int(np.argmin(lengths))
        raise InvalidValueError("direction", directions[k].tolist(), "three finite numbers, not all zero")
    return directions / lengths


def _orthonormal(rotations: Array) -> Array:
    worst = np.abs(np.swapaxes(rotations, -1, -2) @ rotations - np.eye(3)).max(axis=(-2, -1))
    wrong = (worst > 1e-6) | (np.linalg.det(rotations) < 0.0)
    if np.any(wrong):
        k = int(np.argmax(wrong))
        raise InvalidValueError("rotation", rotations[k].tolist(), "a right-handed rotation matrix, to 1e-6")
    return rotations

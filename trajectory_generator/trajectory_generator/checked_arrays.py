"""Checks of arrays from users and files: right shape, finite, and of plausible size for a robot."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from continuum.arrays import Array
from continuum.errors import InvalidValueError

LARGEST = 1e6
"""Largest accepted length [m] or other number; beyond it squares and ratios lose their accuracy."""

SMALLEST_POSITIVE = 1e-9
"""Smallest accepted value of a number that must be positive."""


def finite_array(name: str, values: ArrayLike, shape: tuple[int, ...]) -> Array:
    """Return ``values`` as an array of ``shape``, in which -1 stands for any number of rows.

    Raises:
        InvalidValueError: the values have another shape, are not finite numbers, or exceed ``LARGEST``.
    """
    words = " x ".join("n" if size < 0 else str(size) for size in shape)
    allowed = f"{words} finite numbers within +-{LARGEST:g}"
    try:
        array = np.array(values, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise InvalidValueError(name, values, allowed) from None
    if array.ndim != len(shape) or any(have != want >= 0 for have, want in zip(array.shape, shape, strict=True)):
        raise InvalidValueError(name, "an array of " + " x ".join(map(str, array.shape)), allowed)
    for index in np.argwhere(~(np.abs(array) <= LARGEST)):
        raise InvalidValueError(name + "".join(f"[{i}]" for i in index), float(array[tuple(index)]), allowed)
    return array


def rotation_matrices(name: str, values: ArrayLike) -> Array:
    """Return ``values`` as rotation matrices (n, 3, 3).

    Raises:
        InvalidValueError: the shape is wrong, or a matrix is not orthonormal and right-handed to 1e-6.
    """
    matrices = finite_array(name, values, (-1, 3, 3))
    error = np.abs(matrices.transpose(0, 2, 1) @ matrices - np.eye(3)).max(axis=(1, 2), initial=0.0)
    for i in np.flatnonzero((error > 1e-6) | (np.linalg.det(matrices) < 0)):
        raise InvalidValueError(f"{name}[{i}]", matrices[i].tolist(), "a right-handed rotation matrix, exact to 1e-6")
    return matrices


def positive(name: str, value: float, unit: str) -> float:
    """Return ``value`` if it is between ``SMALLEST_POSITIVE`` and ``LARGEST``.

    Raises:
        InvalidValueError: it is not in this range.
    """
    if not SMALLEST_POSITIVE <= value <= LARGEST:
        raise InvalidValueError(name, value, f"a number from {SMALLEST_POSITIVE:g} to {LARGEST:g} {unit}")
    return float(value)

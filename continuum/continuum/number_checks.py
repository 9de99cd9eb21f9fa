"""Checks of numbers from users and files: arrays of finite floats with a given shape."""

from __future__ import annotations

import math

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError

_FEW = 20  # up to so many numbers, Python checks faster than NumPy


def finite_array(name: str, given: object, allowed: str) -> Array:
    """Return ``given`` as a new array of floats in C order.

    Raises:
        InvalidValueError: an item is not a number or not finite; for arrays with rows the message names the row.
    """
    try:
        array = np.array(given, order="C")
    except (TypeError, ValueError, OverflowError):  # for example rows of different lengths
        raise InvalidValueError(name, given, allowed) from None
    if array.dtype.kind not in "iuf" or (isinstance(given, list | tuple) and _holds_a_truth_value(given)):
        raise InvalidValueError(name, given, allowed)
    if array.dtype != np.float64:
        array = array.astype(float)
    if not _is_finite(array):
        if array.ndim > 1 and len(array) > 1:
            row = int(np.argmin(np.isfinite(array).reshape(len(array), -1).all(axis=1)))
            raise InvalidValueError(f"{name}[{row}]", array[row].tolist(), "finite numbers")
        raise InvalidValueError(name, array.tolist(), allowed)
    return array


def finite_of_shape(name: str, given: object, shape: tuple[int, ...]) -> Array:
    """Return ``given`` as a new finite array of ``shape`` (-1 for any size) in C order, as compiled code expects it.

    Raises:
        InvalidValueError: ``given`` is not such an array.
    """
    if type(given) is np.ndarray and given.dtype == np.float64 and _fits(given.shape, shape) and _is_finite(given):
        return given.copy("C")  # fast path for the usual case
    array = finite_array(name, given, _words(shape))
    if not _fits(array.shape, shape):
        raise InvalidValueError(name, array.tolist(), _words(shape))
    return array


def finite_number(name: str, given: object, allowed: str = "a finite number") -> float:
    """Return ``given`` as a float.

    Raises:
        InvalidValueError: it is not a finite number.
    """
    if type(given) is not float:
        given = finite_array(name, given, allowed)
        if given.ndim:
            raise InvalidValueError(name, given.tolist(), allowed)
        given = float(given)
    if not -np.inf < given < np.inf:
        raise InvalidValueError(name, given, allowed)
    return given


def _is_finite(array: Array) -> bool:
    if array.size > _FEW:
        return bool(np.isfinite(array).all())
    return all(map(math.isfinite, array.ravel().tolist()))


def _holds_a_truth_value(given: list[object] | tuple[object, ...]) -> bool:
    return any(isinstance(value, bool | np.bool_) for value in given)


def _fits(found: tuple[int, ...], shape: tuple[int, ...]) -> bool:
    if found == shape:
        return True
    return len(found) == len(shape) and all(b in (-1, a) for a, b in zip(found, shape, strict=True))


def _words(shape: tuple[int, ...]) -> str:
    if shape == (-1,):
        return "a list of finite numbers"
    lengths = " x ".join("n" if count < 0 else str(count) for count in shape)
    return "three finite numbers" if shape == (3,) else f"finite numbers, {lengths}"

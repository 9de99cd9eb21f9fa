"""Numbers that were given from outside, checked: arrays of finite floats, and of a shape."""

from __future__ import annotations

import math

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError

_FEW = 20  # numbers that Python looks through sooner than NumPy


def finite_array(name: str, given: object, allowed: str) -> Array:
    """``given`` as a new array of floats in C order.

    Raises:
        InvalidValueError: it holds what is no number, or is not finite; the name tells the row where there are many.
    """
    try:
        array = np.array(given, order="C")
    except (TypeError, ValueError, OverflowError):  # rows of different lengths, say
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
    """``given`` as a new array of ``shape``, -1 for any number, all finite, in C order as compiled code expects it.

    Raises:
        InvalidValueError: it is none.
    """
    if type(given) is np.ndarray and given.dtype == np.float64 and _fits(given.shape, shape) and _is_finite(given):
        return given.copy("C")  # the usual case, in little time
    array = finite_array(name, given, _words(shape))
    if not _fits(array.shape, shape):
        raise InvalidValueError(name, array.tolist(), _words(shape))
    return array


def finite_number(name: str, given: object, allowed: str = "a finite number") -> float:
    """``given`` as a float.

    Raises:
        InvalidValueError: it is none.
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

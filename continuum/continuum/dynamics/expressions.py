"""Elementwise functions for numbers and symbols alike, so that every equation is written once.

The equations of this package are plain NumPy. Arrays of floats give floats; object arrays of CasADi symbols give
expressions, from which `compiled/` derives exact derivatives and compiled code. NumPy's sin, cos, exp, tanh, abs, sums
and products support both. Functions with comparisons do not, and are defined here.

Parameters and states are arrays, (n,) or (1,), never bare symbols: CasADi would treat a bare symbol to the left of an
array as a column.
"""

from __future__ import annotations

from typing import Any

import casadi
import numpy as np

type Numbers = Any
"""An array of floats or of symbols, which NumPy's types cannot express."""


def where_positive(x: Numbers, yes: Any, no: Any) -> Numbers:
    """``yes`` where ``x`` > 0, else ``no``, elementwise."""
    if not _symbolic(x, yes, no):
        return np.where(x > 0, yes, no)
    parts = np.broadcast_arrays(*(np.asarray(part, dtype=object) for part in (x, yes, no)))
    chosen = np.empty(parts[0].shape, dtype=object)
    for index in np.ndindex(chosen.shape):
        chosen[index] = casadi.if_else(parts[0][index] > 0, parts[1][index], parts[2][index])
    return chosen


def positive_part(x: Numbers) -> Numbers:
    """``x`` where it is positive, else 0: a cable can pull but not push."""
    return (x + np.abs(x)) / 2


def smooth_sign(x: Numbers, slope: Numbers) -> Numbers:
    """tanh(slope x): the sign of x, smoothed at the origin; ``slope`` in units of 1 / x."""
    return np.tanh(slope * x)


def suffix_sum(x: Numbers) -> Numbers:
    """Sums from every element to the end, along the first axis."""
    return np.cumsum(x[::-1], axis=0)[::-1]


def _symbolic(*parts: Any) -> bool:
    return any(np.asarray(part).dtype == object for part in parts)

"""Elementwise functions that work on numbers and on symbols alike, so that every equation is written once.

The equations of this package are plain NumPy. Given arrays of floats they give floats; given object arrays of CasADi
symbols they give expressions, from which exact derivatives and compiled code are made (`compiled/`). NumPy's own sin,
cos, exp, tanh, abs, sums and products already do both; what decides by a comparison does not, and stands here.

Parameters and states are arrays, (n,) or (1,), never bare symbols: a bare symbol on the left of an array is taken by
CasADi for a column of its own.
"""

from __future__ import annotations

from typing import Any

import casadi
import numpy as np

type Numbers = Any
"""An array of floats, or of symbols, which NumPy's own types cannot tell."""


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
    """``x`` where it is positive, else 0: a cable pulls, never pushes."""
    return (x + np.abs(x)) / 2


def smooth_sign(x: Numbers, sensitivity: Numbers) -> Numbers:
    """tanh(slope x): the sign of x, smoothed at the origin; ``slope`` in units of 1 / x."""
    return np.tanh(sensitivity * x)


def suffix_sum(x: Numbers) -> Numbers:
    """Sums from every element to the end, along the first axis."""
    return np.cumsum(x[::-1], axis=0)[::-1]


def _symbolic(*parts: Any) -> bool:
    return any(np.asarray(part).dtype == object for part in parts)

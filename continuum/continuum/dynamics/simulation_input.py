"""Checks of the arguments of a simulation."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.errors import InvalidValueError
from continuum.number_checks import finite_array

__all__ = ["finite_array", "initial_state", "output_times"]


def initial_state(model: Model, given: object) -> Array:
    """Return a complete state (2 n + n_states,) from a complete state, or from joint angles (n,) at rest.

    Raises:
        InvalidValueError: the argument has the wrong size or is not finite.
    """
    n, size = model.n_joints, 2 * model.n_joints + model.n_states
    allowed = f"{size} finite numbers, or the {n} joint angles"
    x = finite_array("initial state", given, allowed)
    if x.shape == (n,):
        x = np.concatenate([x, np.zeros(size - n)])
    if x.shape != (size,):
        raise InvalidValueError("initial state", given, allowed)
    return x


def output_times(given: object) -> Array:
    """Return times (n_times,) [s] as floats.

    Raises:
        InvalidValueError: there are no times, or they are not finite or not increasing.
    """
    allowed = "finite, increasing numbers [s]"
    times = finite_array("times", given, allowed)
    if times.ndim != 1 or times.size < 1 or np.any(np.diff(times) <= 0):
        raise InvalidValueError("times", given, allowed)
    return times

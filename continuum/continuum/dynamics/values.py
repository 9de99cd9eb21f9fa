"""All parameter values of a model as one vector, for fits and compiled code."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.model import Model


def parameter_vector(model: Model) -> Array:
    """Return the values in the order of `Model.values`, (n_p,)."""
    return np.concatenate([np.asarray(value, dtype=float) for value in model.values().values()])


def parameter_slots(model: Model) -> dict[str, slice]:
    """Return the position of each parameter in that vector."""
    slots, at = {}, 0
    for name, value in model.values().items():
        slots[name] = slice(at, at + len(value))
        at += len(value)
    return slots


def shared_directions(model: Model, names: Sequence[str]) -> Array:
    """Return directions in the vector, one per name, that change a parameter equally in all joints, (n_p, n_names)."""
    slots = parameter_slots(model)
    directions = np.zeros((parameter_vector(model).size, len(names)))
    for column, name in enumerate(names):
        directions[slots[name], column] = 1.0
    return directions


def with_vector(model: Model, values: Array) -> Model:
    """Return the model with a vector of all its values; unchecked."""
    return model.built_from({name: values[slot] for name, slot in parameter_slots(model).items()})

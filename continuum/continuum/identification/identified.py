"""The result of an identification: the model with its values, and their intervals (thesis Table 3)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.identification.estimate import Estimate


@dataclass(frozen=True)
class Identified:
    """An identified model.

    Attributes:
        method: method of identification.
        model: model with the identified values.
        values: values of the identified parameters; means over the joints where the joint is None.
        error: open-loop error of the fitted segments divided by the sensors' noise; NaN if the method has none.
        limit: value up to which that error may be chance; NaN likewise.
        undetermined: names of parameters about which the recordings say little.
    """

    method: str
    model: Model
    values: tuple[Estimate, ...]
    error: float = math.nan
    limit: float = math.nan
    undetermined: tuple[str, ...] = ()


def with_identified(model: Model, values: Sequence[Estimate], source: str) -> Model:
    """Return the model with identified values.

    A value of all joints is their mean: joints keep the proportions that they have in the model.

    Args:
        model: model with nominal values.
        values: values of its parameters.
        source: origin of the values, for the model file.
    """
    changed: dict[str, Array] = {}
    for one in values:
        given = model.values()[one.name] if one.name not in changed else changed[one.name]
        now = np.broadcast_to(given, (model.n_joints,)).astype(float)
        if one.joint is None:
            mean = now.mean()
            now = now * (one.value / mean) if mean > 0 else np.full_like(now, one.value)
        else:
            now[one.joint] = one.value
        changed[one.name] = now
    found = model.with_values(_plain(changed))
    return replace(found, sources=dict(model.sources) | dict.fromkeys(changed, source))


def _plain(values: Mapping[str, Array]) -> dict[str, Array | float]:
    """Return one number for a parameter that is the same at all joints."""
    return {name: float(value[0]) if np.ptp(value) == 0 else value for name, value in values.items()}

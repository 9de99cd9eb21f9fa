"""What an identification gives: the model with its values, and their intervals (thesis Table 3)."""

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
        method: by which it was found.
        model: with the identified values.
        values: of the parameters that were sought; the mean over the joints where the joint is None.
        error: open-loop error of the fitted segments by the sensors' noise; NaN where the method does not know it.
        limit: up to which that error may be chance; NaN likewise.
        undetermined: names of parameters about which the recordings say little.
    """

    method: str
    model: Model
    values: tuple[Estimate, ...]
    error: float = math.nan
    limit: float = math.nan
    undetermined: tuple[str, ...] = ()


def with_identified(model: Model, values: Sequence[Estimate], source: str) -> Model:
    """The model with identified values.

    A value of all joints is their mean: joints keep the proportions that they have in the model.

    Args:
        model: with nominal values.
        values: of its parameters.
        source: where they are from, for the model file.
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
    """One number where all joints have the same."""
    return {name: float(value[0]) if np.ptp(value) == 0 else value for name, value in values.items()}

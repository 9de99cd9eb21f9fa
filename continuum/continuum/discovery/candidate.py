"""An effect as an extension of a model: the model with it, absent at first, and what of it is unknown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model import ActiveEffect, Model
from continuum.identification.free import Free, FreeSpace

USUAL, SMALL = 0.3, 0.03
"""Parts of a typical size at which a fit begins an effect that cannot be negative: the second of one that must be
small, since the model without it explains the data nearly."""


@dataclass(frozen=True)
class Addition:
    """One effect of an extension.

    Attributes:
        effect: its name.
        joints: where it acts, from 0; None at all, or where it has nothing to do with single joints.
    """

    effect: str
    joints: tuple[int, ...] | None = None

    def __str__(self) -> str:
        return self.effect + ("" if self.joints is None else "@" + ",".join(str(joint + 1) for joint in self.joints))


type Extension = tuple[Addition, ...]
"""Effects beyond Eq. 12; () is Eq. 12 itself."""


def extended(model: Model, extension: Extension) -> Model:
    """The model with all effects of an extension, each absent until its parameters are moved."""
    added = []
    for addition in extension:
        effect = effect_named(addition.effect)
        values = {
            name: parameter.array(parameter.default, model.n_joints, f"{addition.effect}.{name}")
            for name, parameter in effect.parameters.items()
        }
        added.append(ActiveEffect(effect, values))
    return replace(model, effects=model.effects + tuple(added))


def unknowns_of(addition: Addition, n_joints: int, n_recordings: int) -> list[Free]:
    """Unknowns that an effect adds: one for each joint or recording where these have values of their own."""
    found = []
    for name, parameter in effect_named(addition.effect).parameters.items():
        joints: Sequence[int | None] = (addition.joints or range(n_joints)) if parameter.per_joint else (None,)
        runs: Sequence[int | None] = range(n_recordings) if parameter.per_recording else (None,)
        found += [Free(f"{addition.effect}.{name}", joint, run) for joint in joints for run in runs]
    return found


def acts_at_joints(effect: str) -> bool:
    """Whether the effect may be one joint's alone."""
    return any(parameter.per_joint for parameter in effect_named(effect).parameters.values())


def beginning(space: FreeSpace, added: int, part: float = USUAL) -> Array:
    """Coordinates to begin a fit at, (k,): of the last ``added`` at a part of a typical size if it cannot be negative.

    Where an unknown may have either sign, slopes at zero show the way.
    """
    start = np.zeros(space.scale.size)
    one_sided = space.lower > -1e-2
    one_sided[: start.size - added] = False
    start[one_sided] = part
    return space.clipped(start)

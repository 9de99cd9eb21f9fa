"""An effect as an extension of a model: the model with it, absent at first, and what of it is unknown."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model import ActiveEffect, Model
from continuum.identification.free import Free, FreeSpace, is_per_recording


@dataclass(frozen=True)
class Part:
    """One effect of an extension.

    Attributes:
        effect: its name.
        joints: where it acts, from 0; None everywhere, or where it has nothing to do with single joints.
    """

    effect: str
    joints: tuple[int, ...] | None = None

    def __str__(self) -> str:
        where = "" if self.joints is None else " at joint " + ", ".join(str(j + 1) for j in self.joints)
        return self.effect + where


Extension = tuple[Part, ...]
"""Effects beyond Eq. 12; () is Eq. 12 itself."""


def extended(model: Model, extension: Extension) -> Model:
    """The model with all effects of an extension, each absent until its parameters are moved."""
    added = []
    for part in extension:
        effect = effect_named(part.effect)
        values = {
            name: parameter.array(parameter.default, model.n_joints, f"{part.effect}.{name}")
            for name, parameter in effect.parameters.items()
        }
        added.append(ActiveEffect(effect, values))
    return replace(model, effects=model.effects + tuple(added))


def unknowns_of(model: Model, extension: Extension) -> list[Free]:
    """Unknowns that the extension adds; a parameter that joints have each of their own gives one for each joint."""
    found = []
    for part in extension:
        for name, parameter in effect_named(part.effect).parameters.items():
            full = f"{part.effect}.{name}"
            if not parameter.per_joint:
                found.append(Free(full))
                continue
            found += [Free(full, joint) for joint in (part.joints or range(model.n_joints))]
    return found


def beginning(model: Model, free: list[Free]) -> Array:
    """Coordinates to begin a fit at, (k,): what may have either sign begins absent, what has one sign at its typical size.

    Slopes at zero show the way only where zero lies within the bounds.
    """
    space = FreeSpace(model, [unknown for unknown in free if not is_per_recording(model, unknown)])
    one_sided = (space.lower > -1e-3) & ["." in unknown.name for unknown in space.unknowns]
    return space.clipped(np.where(one_sided, 1.0, 0.0))

"""What a model's values come to in its equations: where these numbers are equal, models move and are measured alike."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect
from continuum.dynamics.model import Model

_HOOKS = [name for name, hook in vars(Effect).items() if callable(hook) and name != "change_parameters"]
"""By which an effect's values act other than by changing the parameters of Eq. 12."""


def effective_values(model: Model) -> Array:
    """Parameters of Eq. 12 as the effects make them, then values of those effects that do more than that, (m,).

    A spring that is stiffer by a tenth is one number, whether K says so or an effect that changes K.
    """
    values = [value for active in model.effects if _does_more(active.effect) for value in active.values.values()]
    parameters = model.changed_parameters.named().values()
    return np.concatenate([np.asarray(value, dtype=float) for value in (*parameters, *values)])


def _does_more(effect: Effect) -> bool:
    """Whether its values act by themselves, too, or change parameters otherwise from recording to recording."""
    acts = any(getattr(type(effect), hook) is not getattr(Effect, hook) for hook in _HOOKS)
    return acts or any(meaning.per_recording for meaning in effect.parameters.values())

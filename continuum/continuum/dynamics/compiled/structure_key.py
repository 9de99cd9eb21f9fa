"""Key of the equations that are traced from a model: the model's structure and the source files of the equations."""

from __future__ import annotations

import inspect
from pathlib import Path

from continuum.compiled_code import sources_digest
from continuum.dynamics.model import Model

_PACKAGE = Path(__file__).parents[2]
_SOURCES = (_PACKAGE / "dynamics", _PACKAGE / "effects")


def structure_key(model: Model, *sources: Path) -> str | None:
    """Return a key that is equal for models with equal traced equations; None if an effect is defined elsewhere.

    Args:
        model: the model; the key depends on the number of its parameter values, not on the values.
        sources: source files of the equations besides those of dynamics and effects.
    """
    classes = [type(active.effect) for active in model.effects]
    if not all(any(Path(inspect.getfile(one)).is_relative_to(place) for place in _SOURCES) for one in classes):
        return None  # its further dependencies are unknown
    digest = sources_digest(*_SOURCES, *sources)
    effects = [f"{one.__module__}.{one.__qualname__}" for one in classes]
    values = [f"{name} {len(value)}" for name, value in model.values().items()]
    return "\n".join([digest, model.inputs.value, *effects, *values])

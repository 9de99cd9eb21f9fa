"""What equations depend on that are traced from a model: its structure, and the sources that they are written in."""

from __future__ import annotations

import inspect
from pathlib import Path

from continuum.compiled_code import sources_digest
from continuum.dynamics.model import Model

_PACKAGE = Path(__file__).parents[2]
_SOURCES = (_PACKAGE / "dynamics", _PACKAGE / "effects")


def structure_key(model: Model, *sources: Path) -> str | None:
    """The same for models whose traced equations are the same; None where an effect is written elsewhere.

    Args:
        model: whose parameter values do not matter, their number does.
        sources: files that the equations are written in, besides those of dynamics and effects.
    """
    classes = [type(active.effect) for active in model.effects]
    if not all(any(Path(inspect.getfile(one)).is_relative_to(place) for place in _SOURCES) for one in classes):
        return None  # what else it depends on is not known
    digest = sources_digest(*_SOURCES, *sources)
    effects = [f"{one.__module__}.{one.__qualname__}" for one in classes]
    values = [f"{name} {len(value)}" for name, value in model.values().items()]
    return "\n".join([digest, model.inputs.value, *effects, *values])

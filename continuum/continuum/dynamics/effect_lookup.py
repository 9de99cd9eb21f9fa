"""Effects by name, found through the entry point group ``continuum.effects``."""

from __future__ import annotations

import sys
from functools import cache
from importlib.metadata import EntryPoint, entry_points

from continuum.dynamics.effect import Effect
from continuum.errors import InvalidValueError

GROUP = "continuum.effects"


def effect_named(name: str) -> Effect:
    """Return a new instance of the effect called ``name``.

    Raises:
        InvalidValueError: no installed package offers an effect of that name.
    """
    offered = _offered()
    if name not in offered:
        raise InvalidValueError(
            "effect", name, "one of " + (", ".join(sorted(offered)) or "none: no effect is installed")
        )
    effect: Effect = offered[name].load()()
    return effect


def effect_names() -> list[str]:
    """Return the names of all installed effects."""
    return sorted(_offered())


def _offered() -> dict[str, EntryPoint]:
    return _offered_on(tuple(sys.path))


@cache
def _offered_on(_path: tuple[str, ...]) -> dict[str, EntryPoint]:
    """Return the effects of the packages on a path; cached, because a search needs hundreds of effects."""
    return {entry.name: entry for entry in entry_points(group=GROUP)}

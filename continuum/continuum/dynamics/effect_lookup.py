"""Effects by name, found through the entry point group ``continuum.effects``."""

from __future__ import annotations

import sys
from functools import cache
from importlib.metadata import EntryPoint, entry_points

from continuum.dynamics.effect import Effect
from continuum.errors import InvalidValueError

GROUP = "continuum.effects"


def effect_named(name: str) -> Effect:
    """A new instance of the effect called ``name``.

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
    """Names of all effects that are installed."""
    return sorted(_offered())


def _offered() -> dict[str, EntryPoint]:
    return _offered_on(tuple(sys.path))


@cache
def _offered_on(_path: tuple[str, ...]) -> dict[str, EntryPoint]:
    """Of the packages on a path: they are read once, a search asks for effects by the hundred."""
    return {entry.name: entry for entry in entry_points(group=GROUP)}

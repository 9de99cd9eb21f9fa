"""Orders to the running emulator, one per line.

[at SECONDS] ACTION [NAME=VALUE ...]        at 12.5 lose share=0.2 for=3 way=up
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from continuum.errors import InvalidValueError

WAYS = ("up", "down", "both")
"""Directions of the line: up is towards the host."""


@dataclass(frozen=True)
class Number:
    """A number in an order: its default, or None if it is required, its bounds and its meaning."""

    default: float | None
    lower: float
    upper: float
    meaning: str


_FOR = Number(1.0, 0.0, 1e6, "duration [s]")
_SHARE = Number(1.0, 0.0, 1.0, "fraction of the frames")
_SENSOR = Number(None, 1.0, 10.0, "number of the sensor, from 1 at the base")

ON_THE_LINE: Mapping[str, Mapping[str, Number]] = {
    "lose": {"share": _SHARE, "for": _FOR},
    "damage": {"share": _SHARE, "for": _FOR},
    "repeat": {"share": _SHARE, "for": _FOR},
    "late": {"share": _SHARE, "for": _FOR, "by": Number(0.2, 0.0, 60.0, "[s]")},
    "noise": {"share": _SHARE, "for": _FOR, "size": Number(100.0, 1.0, 1e4, "most bytes before a frame")},
}
"""Faults of frames; they also accept ``way=up|down|both``, up by default."""

ACTIONS: Mapping[str, Mapping[str, Number]] = {
    **ON_THE_LINE,
    "drop": {"sensor": _SENSOR, "for": _FOR},
    "mute": {"for": Number(1.0, 0.0, 1e6, "time for which no frames of the sensors are sent [s]")},
    "clip": {"sensor": _SENSOR, "for": _FOR, "range": Number(20.0, 0.0, 2000.0, "range of its rates [deg/s]")},
    "battery": {"sensor": _SENSOR, "percent": Number(10.0, 0.0, 100.0, "charge of its battery [%]")},
    "drift": {"ppm": Number(None, -1000.0, 1000.0, "drift of the controller's clock, positive if fast [1e-6]")},
    "unplug": {"for": _FOR},
    "freeze": {"for": Number(1.0, 0.0, 1e6, "time for which input from the host is ignored [s]")},
    "reboot": {},
    "hand": {
        "bend": Number(90.0, -270.0, 270.0, "total bend, equal at every joint [deg]"),
        "over": Number(1.0, 0.01, 1e3, "duration of the movement [s]"),
        "hold": Number(2.0, 0.0, 1e6, "time for which the hand then holds the arm before the release [s]"),
    },
    "clear": {},
}
"""All actions by name. `clear` ends all active faults and discards all scheduled orders."""


@dataclass(frozen=True)
class Order:
    """One order.

    Attributes:
        action: one of `ACTIONS`.
        numbers: values of all numbers of the action.
        way: direction, for faults of the line.
        at: time since the start [s]; 0 for at once.
    """

    action: str
    numbers: Mapping[str, float]
    way: str = "up"
    at: float = 0.0


def read_order(line: str) -> Order:
    """Parse the order in a line.

    Raises:
        InvalidValueError: the line is not an order.
    """
    words = line.split()
    at = 0.0
    if words and words[0] == "at":
        at = _number("at", words[1] if len(words) > 1 else "", Number(None, 0.0, math.inf, ""))
        words = words[2:]
    if not words or words[0] not in ACTIONS:
        raise InvalidValueError("order", line, "[at SECONDS] and one of " + ", ".join(ACTIONS))
    action, specs = words[0], ACTIONS[words[0]]
    given, way = {}, "up"
    for word in words[1:]:
        name, _, text = word.partition("=")
        if name == "way" and action in ON_THE_LINE:
            if text not in WAYS:
                raise InvalidValueError("way", text, "one of " + ", ".join(WAYS))
            way = text
        elif name in specs:
            given[name] = _number(name, text, specs[name])
        else:
            allowed = [*specs, *(["way"] if action in ON_THE_LINE else [])]
            raise InvalidValueError(f"{action}: {name}", word, "NAME=VALUE of " + (", ".join(allowed) or "none"))
    for name, spec in specs.items():
        if name not in given:
            if spec.default is None:
                raise InvalidValueError(f"{action}: {name}", None, f"a value; {spec.meaning}")
            given[name] = spec.default
    return Order(action, given, way, at)


def read_orders(lines: Iterable[str]) -> list[Order]:
    """Parse the orders of a script, sorted by time; ignore empty lines and comments after a #.

    Raises:
        InvalidValueError: a line is not an order.
    """
    texts = (line.partition("#")[0].strip() for line in lines)
    return sorted((read_order(text) for text in texts if text), key=lambda order: order.at)


def in_words() -> str:
    """Describe all orders for the help text."""
    lines = []
    for action, specs in ACTIONS.items():
        shown = [f"{name}={'?' if spec.default is None else f'{spec.default:g}'}" for name, spec in specs.items()]
        lines.append("  " + " ".join([action, *shown, *(["way=up"] if action in ON_THE_LINE else [])]))
    return "\n".join(lines)


def _number(name: str, text: str, spec: Number) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not spec.lower <= value <= spec.upper or math.isinf(value):
        raise InvalidValueError(name, text, f"a number from {spec.lower:g} to {spec.upper:g} {spec.meaning}".rstrip())
    return value

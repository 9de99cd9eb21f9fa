"""Assessment of a verdict against the truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import Enum
from typing import Any, Final

_ALL_JOINTS: Final = (1, 2, 3, 4, 5)  # of the plants' arms


class Answer(Enum):
    """Assessments from the best to the worst."""

    RIGHT = "right"
    SET = "in a set"
    PART = "part"
    UNKNOWN = "unknown"
    ADEQUATE = "missed"
    FAILED = "failed"
    WRONG_SET = "wrong set"
    WRONG_CAUSE = "wrong cause"


type Entry = Mapping[str, Any]
"""A hidden effect (`name`, `joint`), or a named one (`effect`, `joints`)."""


def answer(hidden: Sequence[Entry], verdict: Mapping[str, Any] | None) -> Answer:
    """Assess a verdict.

    A verdict is right if it is `cause` with exactly the hidden effects, each at its joint, or at all joints if it
    belongs to the whole arm. A wrong cause names any other effect, alone or in addition to the hidden ones. If an
    effect outside of the library is hidden, `unknown` is right, and any verdict that declares itself incomplete; if
    nothing is hidden, `adequate` is right.

    Args:
        hidden: effects as reported by the plants.
        verdict: as written by `continuum diagnose --json`; None if there is none.
    """
    if verdict is None:
        return Answer.FAILED
    kind = verdict["verdict"]
    if kind not in ("adequate", "cause", "ambiguous", "unknown"):
        raise ValueError(f"verdict is {kind!r}; allowed: adequate, cause, ambiguous, unknown")
    if any(not effect["in_a_library"] for effect in hidden) and (kind == "unknown" or not verdict["complete"]):
        return Answer.RIGHT
    if kind == "unknown":
        return Answer.UNKNOWN
    if kind == "adequate":
        return Answer.ADEQUATE if hidden else Answer.RIGHT
    sets = [one["effects"] for one in verdict["sets"]]
    if any(is_exactly(hidden, one) for one in sets):
        return Answer.RIGHT if kind == "cause" else Answer.SET
    if all(one and all(_is_part(hidden, cause) for cause in one) for one in sets):
        return Answer.PART
    return Answer.WRONG_CAUSE if kind == "cause" else Answer.WRONG_SET


def is_exactly(hidden: Sequence[Entry], named: Sequence[Entry]) -> bool:
    """Return whether a set names every hidden effect at its joints, and nothing else."""
    return len(hidden) == len(named) and all(any(is_it(effect, cause) for cause in named) for effect in hidden)


def is_it(effect: Entry, named: Entry) -> bool:
    """Return whether a named effect is the hidden one at its joint, or at all joints."""
    joints = None if named["joints"] is None else tuple(named["joints"])
    wanted = (None, _ALL_JOINTS) if effect["joint"] is None else ((effect["joint"],),)
    return bool(effect["name"] == named["effect"]) and joints in wanted


def _is_part(hidden: Sequence[Entry], named: Entry) -> bool:
    """Return whether a named effect is one of the hidden ones, possibly at only some of its joints."""
    return any(is_it(e, named) or (e["name"] == named["effect"] and e["joint"] is None) for e in hidden)


def label(causes: Sequence[Entry]) -> str:
    """Return the effects and joints of a set as text."""
    at = ("" if (joints := cause["joints"]) is None else "@" + ",".join(map(str, joints)) for cause in causes)
    return " + ".join(cause["effect"] + where for cause, where in zip(causes, at, strict=True)) or "nothing"

"""What a verdict is worth beside the truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import Enum
from typing import Any


class Answer(Enum):
    """From the worst to the best."""

    WRONG_CAUSE = "wrong cause"
    WRONG_JOINT = "right effect at a wrong joint"
    OTHER_SET = "ambiguous without it"
    UNKNOWN = "unknown"
    ADEQUATE = "missed: adequate"
    FAILED = "no verdict"
    PART = "one of two"
    SET = "in an ambiguous set"
    RIGHT = "right"


type Entry = Mapping[str, Any]
"""A hidden effect (`name`, `joint`), or a named one (`effect`, `joint`, ..)."""


def answer(hidden: Sequence[Entry], verdict: Mapping[str, Any] | None) -> Answer:
    """Judge a verdict.

    Right is `cause` with every hidden effect and no other, each at its joint where it belongs to one; `unknown` where
    an effect outside of the library is hidden; `adequate` where nothing is.

    Args:
        hidden: effects as the plant tells them.
        verdict: as `continuum diagnose --json` writes it.
    """
    if verdict is None:
        return Answer.FAILED
    outside = any(not effect["in_a_library"] for effect in hidden)
    match verdict["verdict"]:
        case "adequate":
            return Answer.ADEQUATE if hidden else Answer.RIGHT
        case "unknown":
            return Answer.RIGHT if outside else Answer.UNKNOWN
        case "ambiguous":
            named = [*verdict["causes"], *verdict["alternatives"]]
            found = bool(hidden) and all(any(is_it(effect, entry) for entry in named) for effect in hidden)
            return Answer.SET if found else Answer.OTHER_SET
        case "cause":
            return _of_causes(hidden, verdict["causes"])
    raise ValueError(f"verdict is {verdict['verdict']!r}; allowed: adequate, cause, ambiguous, unknown")


def is_it(effect: Entry, named: Entry) -> bool:
    """Whether a named effect is the hidden one, at its joint."""
    return bool(effect["name"] == named["effect"] and effect["joint"] in (None, named["joint"]))


def _of_causes(hidden: Sequence[Entry], causes: Sequence[Entry]) -> Answer:
    if not {cause["effect"] for cause in causes} <= {effect["name"] for effect in hidden}:
        return Answer.WRONG_CAUSE
    if not all(any(is_it(effect, cause) for effect in hidden) for cause in causes):
        return Answer.WRONG_JOINT
    return Answer.RIGHT if len(causes) == len(hidden) else Answer.PART


def label(verdict: Mapping[str, Any] | None) -> str:
    """Column of the confusion matrix: the effect that is named alone, or the kind of the verdict."""
    if verdict is None:
        return "no verdict"
    if verdict["verdict"] != "cause":
        return str(verdict["verdict"])
    return str(verdict["causes"][0]["effect"]) if len(verdict["causes"]) == 1 else "several"

"""What a verdict is worth beside the truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import Enum
from typing import Any

_ALL_JOINTS = [1, 2, 3, 4, 5]  # of the plant's arms


class Answer(Enum):
    """From the worst to the best."""

    WRONG_CAUSE = "wrong cause"
    WRONG_JOINT = "right effect at a wrong joint"
    OTHER_SET = "ambiguous without it"
    UNKNOWN = "unknown"
    ADEQUATE = "missed: adequate"
    FAILED = "no verdict"
    PART = "in part"
    SET = "in an ambiguous set"
    RIGHT = "right"


type Entry = Mapping[str, Any]
"""A hidden effect (`name`, `joint`), or a named one (`effect`, `joint`, ..)."""


def answer(hidden: Sequence[Entry], verdict: Mapping[str, Any] | None) -> Answer:
    """Judge a verdict.

    Right is `cause` with every hidden effect and no other, each at its joint where it belongs to one and else at all;
    in part it is with one of two effects, or at some of the joints; right is also `unknown` where an effect outside of
    the library is hidden, and `adequate` where nothing is.

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
    """Whether a named effect is the hidden one, at its joint; of the whole arm's one joint is enough."""
    return bool(effect["name"] == named["effect"] and effect["joint"] in (None, named["joint"]))


def _is_whole(effect: Entry, named: Entry) -> bool:
    """Whether it is named at all joints where it is hidden."""
    return is_it(effect, named) and (effect["joint"] is not None or named["joints"] in (None, _ALL_JOINTS))


def _of_causes(hidden: Sequence[Entry], causes: Sequence[Entry]) -> Answer:
    if not {cause["effect"] for cause in causes} <= {effect["name"] for effect in hidden}:
        return Answer.WRONG_CAUSE
    if not all(any(is_it(effect, cause) for effect in hidden) for cause in causes):
        return Answer.WRONG_JOINT
    all_named = all(any(_is_whole(effect, cause) for cause in causes) for effect in hidden)
    return Answer.RIGHT if all_named else Answer.PART


def label(verdict: Mapping[str, Any] | None) -> str:
    """Column of the confusion matrix: the effect that is named alone, or the kind of the verdict."""
    if verdict is None:
        return "no verdict"
    if verdict["verdict"] != "cause":
        return str(verdict["verdict"])
    return str(verdict["causes"][0]["effect"]) if len(verdict["causes"]) == 1 else "several"

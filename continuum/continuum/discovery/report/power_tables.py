"""What the recordings would have shown: the smallest size of every effect at each joint, or the reason why not."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

from continuum.discovery.report.names import capital, effect_in_words, listed
from continuum.discovery.report.quantities import Scale, meaning_in_words, number, scale_of
from continuum.discovery.result import Detectable, Diagnosis
from continuum.dynamics.effect_lookup import effect_named
from continuum.languages import Translator

_DIGITS: Final = 2


class Cell(NamedTuple):
    """Smallest size that would have been named, and whether it is no more than the typical one."""

    text: str
    is_shown: bool


class PowerRow(NamedTuple):
    """One of the sizes of an effect.

    Attributes:
        name, id, meaning, unit, typical: texts on the size.
        whole: smallest size on the whole arm, or at several joints at once; None if not evaluated.
        joints: smallest size at each joint; None if not evaluated.
    """

    name: str
    id: str
    meaning: str
    unit: str
    typical: str
    whole: Cell | None
    joints: tuple[Cell | None, ...]


class Hidden(NamedTuple):
    """Effects that would not have been shown at their typical sizes for one reason."""

    names: str
    reason: str


def power_rows(result: Diagnosis, tr: Translator) -> list[PowerRow]:
    """Return a row for every effect that is not in the best set, the most detectable first."""
    groups = dict[tuple[str, str], list[Detectable]]()
    for one in _asked(result):
        groups.setdefault((one.effect, one.parameter), []).append(one)
    n = result.n_joints
    return [_row(effect, parameter, found, n, tr) for (effect, parameter), found in groups.items()]


def hidden_effects(result: Diagnosis, tr: Translator) -> list[Hidden]:
    """Return the hidden effects by reason, with their places."""
    places = dict[str, dict[str, list[Detectable]]]()
    for one in _asked(result):
        if not one.is_shown:
            places.setdefault(one.reason, {}).setdefault(one.effect, []).append(one)
    n = result.n_joints
    return [
        Hidden(capital(listed([_name(ones, n, tr) for ones in effects.values()], tr)), tr(reason))
        for reason, effects in places.items()
    ]


def counts(result: Diagnosis) -> tuple[int, int]:
    """Return how many effects would have been shown at typical size wherever they act, and how many were evaluated."""
    shown = dict[str, bool]()
    for one in _asked(result):
        shown[one.effect] = shown.get(one.effect, True) and one.is_shown
    return sum(shown.values()), len(shown)


def _asked(result: Diagnosis) -> list[Detectable]:
    named = {cause.label for cause in result.causes}
    return [one for one in result.power if one.label not in named]


def _name(ones: Sequence[Detectable], n: int, tr: Translator) -> str:
    single = [one.joints[0] for one in ones if one.joints is not None and len(one.joints) == 1]
    if any(one.joints is None or len(one.joints) > 1 for one in ones) or not single:
        return effect_in_words(ones[0].effect, tr=tr)
    return effect_in_words(ones[0].effect, sorted(single), n, tr)


def _row(effect: str, parameter: str, found: Sequence[Detectable], n: int, tr: Translator) -> PowerRow:
    meaning, first = effect_named(effect).parameters[parameter].meaning, found[0]
    scale = scale_of(first.unit, meaning, parameter)
    at = {one.joints[0]: _cell(one, scale, tr) for one in found if one.joints is not None and len(one.joints) == 1}
    whole = next((_cell(one, scale, tr) for one in found if one.joints is None or len(one.joints) > 1), None)
    return PowerRow(
        capital(effect_in_words(effect, tr=tr)), f"{effect}.{parameter}", meaning_in_words(meaning, tr), scale.unit,
        number(scale(first.typical), _DIGITS), whole, tuple(at.get(joint) for joint in range(n)),
    )  # fmt: skip


def _cell(one: Detectable, scale: Scale, tr: Translator) -> Cell:
    return Cell(number(scale(one.smallest), _DIGITS) if math.isfinite(one.smallest) else tr("none"), one.is_shown)

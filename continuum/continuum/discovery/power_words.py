"""In words: what recordings would have shown, and which run would tell more."""

from __future__ import annotations

import math
from collections.abc import Sequence

from continuum.discovery.result import Detectable, Diagnosis, Experiment, HandTest, Removal, is_named
from continuum.discovery.words import joints_in_words
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.parameters import RATIO
from continuum.languages import ENGLISH, Message, Translator
from continuum.significant_digits import rounded

RECORD_AGAIN = Message("Make the same recordings again, and diagnose these alone.")
_LISTED = 6  # effects that a sentence bears


def power_in_words(result: Diagnosis, tr: Translator = ENGLISH) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """Two tables by effect: the smallest size that would have been shown, and why none would."""
    by_effect: dict[str, list[Detectable]] = {}
    for one in result.power:
        by_effect.setdefault(one.effect, []).append(one)
    shown, hidden = [], []
    for effect, places in by_effect.items():
        seen = [one for one in places if one.is_shown]
        best = min(seen or places, key=lambda one: one.smallest)
        if seen:
            shown.append((effect, _without(_size_at(best, tr), best, places, tr)))
        elif math.isinf(best.smallest):
            hidden.append((effect, tr(best.reason)))
        else:
            hidden.append((effect, f"{tr(best.reason)} {tr('Detectable from {size}.', size=_size_at(best, tr))}"))
    return shown, hidden


def experiment_in_words(result: Diagnosis, tr: Translator = ENGLISH) -> str:
    """The run that tells most, and what it tells; empty where none was worked out."""
    if not result.experiments:
        return ""
    if len(result.sets) > 1 and is_named(result.verdict.kind):
        return separating_in_words(result, tr)
    best = result.experiments[0]
    text = f"{tr(best.name)}. {tr(best.instruction)}"
    if not best.shows:
        return text
    effects = list(dict.fromkeys(label.partition("@")[0] for label in best.shows))
    listed, more = ", ".join(effects[:_LISTED]), len(effects) - _LISTED
    if more > 0:
        listed = tr("{effects} and {count} more", effects=listed, count=more)
    return f"{text} {tr('It would show {effects} where these recordings cannot.', effects=listed)}"


def separating_in_words(result: Diagnosis, tr: Translator = ENGLISH) -> str:
    """What tells the possible causes apart, and what to do with what it gives."""
    match result.separating:
        case None:
            return tr("no standard run or measurement separates the most likely causes; follow the instructions above.")
        case Experiment() as run:
            separates = tr("It should separate the most likely causes.")
            return f"{tr(run.name)}. {repeated(run, tr)} {separates}"
        case Removal() as removal:
            diagnose = tr("Diagnose these with --without {effect}.", effect=removal.effect)
            return f"{tr(removal.instruction)} {tr(RECORD_AGAIN)} {diagnose}"
        case test:
            return f"{tr(test.instruction)} {tr('Then diagnose again with {option}.', option=option(test, tr))}"


def option(test: HandTest, tr: Translator = ENGLISH) -> str:
    """What to type with the value that was measured, in a unit that a mechanic reads from an instrument."""
    unit = {"rad": "deg", "kg": "g", "s": "ms", "1": "%"}.get(test.unit, test.unit)
    return f"--measured {test.name}={tr('VALUE')}{unit}"


def repeated(run: Experiment, tr: Translator = ENGLISH) -> str:
    """The instruction, and how often."""
    if run.runs <= 1:
        return tr(run.instruction)
    return f"{tr(run.instruction)} {tr('Do this {runs} times.', runs=run.runs)}"


def _without(shown: str, best: Detectable, places: Sequence[Detectable], tr: Translator) -> str:
    """A size with the single joints at which the effect would not have been shown."""
    missing = sorted({one.joints[0] for one in places if not one.is_shown and one.joints and len(one.joints) == 1})
    if not missing:
        return shown
    values = {"size": shown, "joints": ", ".join(str(joint + 1) for joint in missing)}
    if best.joints is not None and len(best.joints) > 1:
        return tr.plural(
            "{size}; not at joint {joints} alone", "{size}; not at joint {joints} alone", len(missing), **values
        )
    return tr.plural("{size}; not at joint {joints}", "{size}; not at joint {joints}", len(missing), **values)


def _size_at(one: Detectable, tr: Translator) -> str:
    """The smallest size that would have been shown, and where."""
    size = _size_in_words(one, tr)
    return size if one.joints is None else tr("{size} at {joints}", size=size, joints=joints_in_words(one.joints, tr))


def _size_in_words(one: Detectable, tr: Translator) -> str:
    if one.unit == "rad":
        return tr("{angle} degrees", angle=rounded(math.degrees(one.smallest), 2))
    if effect_named(one.effect).parameters[one.parameter].meaning.endswith(RATIO):
        return f"{rounded(100 * one.smallest, 2)} %"
    return rounded(one.smallest, 2) + f" {one.unit}" * (one.unit != "1")

"""In words: what recordings would have shown, and which run would tell more."""

from __future__ import annotations

import math

from continuum.discovery.result import Detectable, Diagnosis, Experiment, HandTest, Removal, is_named
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.parameters import RATIO

RECORD_AGAIN = "Make the same recordings again, and diagnose these alone."
_LISTED = 6  # effects that a sentence bears


def power_in_words(result: Diagnosis) -> tuple[list[tuple[str, str]], list[tuple[str, str]]]:
    """Two tables by effect: the smallest size that would have been shown, and why none would."""
    by_effect: dict[str, list[Detectable]] = {}
    for one in result.power:
        by_effect.setdefault(one.effect, []).append(one)
    shown, hidden = [], []
    for effect, places in by_effect.items():
        seen = [one for one in places if one.is_shown]
        if seen:
            best = min(seen, key=lambda one: one.smallest)
            missing = [one.joints[0] for one in places if not one.is_shown and one.joints and len(one.joints) == 1]
            alone = " alone" if best.joints is not None and len(best.joints) > 1 else ""
            rest = f"; not at joint {', '.join(str(j + 1) for j in sorted(set(missing)))}{alone}" if missing else ""
            shown.append((effect, f"{_size_in_words(best)}{_at(best)}{rest}"))
        else:
            best = min(places, key=lambda one: one.smallest)
            size = "" if math.isinf(best.smallest) else f" Detectable from {_size_in_words(best)}{_at(best)}."
            hidden.append((effect, f"{best.reason}{size}"))
    return shown, hidden


def experiment_in_words(result: Diagnosis) -> str:
    """The run that tells most, and what it tells; empty where none was worked out."""
    if not result.experiments:
        return ""
    if len(result.sets) > 1 and is_named(result.verdict.kind):
        return separating_in_words(result)
    best = result.experiments[0]
    if not best.shows:
        return f"{best.name}. {best.instruction}"
    effects = list(dict.fromkeys(label.partition("@")[0] for label in best.shows))
    more = f" and {len(effects) - _LISTED} more" if len(effects) > _LISTED else ""
    listed = ", ".join(effects[:_LISTED]) + more
    return f"{best.name}. {best.instruction} It would show {listed} where these recordings cannot."


def separating_in_words(result: Diagnosis) -> str:
    """What tells the possible causes apart, and what to do with what it gives."""
    match result.separating:
        case None:
            return "no standard run or measurement separates the most likely causes; follow the instructions above."
        case Experiment() as run:
            return f"{run.name}. {repeated(run)} It should separate the most likely causes."
        case Removal() as removal:
            return f"{removal.instruction} {RECORD_AGAIN} Diagnose these with --without {removal.effect}."
        case test:
            return f"{test.instruction} Then diagnose again with {option(test)}."


def option(test: HandTest) -> str:
    """What to type with the value that was measured, in a unit that a mechanic reads from an instrument."""
    unit = {"rad": "deg", "kg": "g", "s": "ms", "1": "%"}.get(test.unit, test.unit)
    return f"--measured {test.name}=VALUE{unit}"


def repeated(run: Experiment) -> str:
    """The instruction, and how often."""
    return run.instruction + (f" Do this {run.runs} times." if run.runs > 1 else "")


def _size_in_words(one: Detectable) -> str:
    if one.unit == "rad":
        return f"{math.degrees(one.smallest):.2g} degrees"
    if effect_named(one.effect).parameters[one.parameter].meaning.endswith(RATIO):
        return f"{100 * one.smallest:.2g} %"
    return f"{one.smallest:.2g}" + f" {one.unit}" * (one.unit != "1")


def _at(one: Detectable) -> str:
    if one.joints is None:
        return ""
    return f" at joint{'s' * (len(one.joints) > 1)} {', '.join(str(j + 1) for j in one.joints)}"

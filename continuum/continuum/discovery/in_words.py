"""The verdict in two sentences that a mechanic understands."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from continuum.discovery.candidate import Addition
from continuum.discovery.measured_gain import RunScore
from continuum.discovery.verdict import Cause, Kind, Verdict
from continuum.dynamics.effect_lookup import effect_named
from continuum.identification.fisher import Identifiability

RATE_IN_WORDS = {True: "rate", False: "rate, of the angles' slopes"}
"""Of which an error is told, by whether rates were measured."""
_VAGUE = (
    " They leave much open, though: left to itself the simulation ends far from what was measured, and so it does with "
    "other parameters that explain these data as well. More recordings, of other motions, would tell more."
)
_SMALL = "That is little here: no short stretch asks for it by itself, but all of them together do, and whole runs too."
_NEXT = "Next: record three more runs or more, of other motions, each with the arm at rest at its beginning or end."
_NOTHING_TOLD = 1e5  # conditioning, beyond which some direction is not told at all
_PAIRS = 4  # of estimates that hang together, told of at most; the JSON file has all
_NOTICED = 0.02  # of the distance to the noise floor


def verdict_in_words(verdict: Verdict) -> str:
    """Two sentences, or three where something is to be measured."""
    before, after = (f"{100 * share:.0f} %" for share in verdict.unexplained)
    match verdict.kind:
        case Kind.ADEQUATE:
            return (
                "With its parameters refitted, the simulation explains these data as well as the sensors allow. "
                "Nothing in them asks for a further effect." + (_VAGUE if verdict.vague else "")
            )
        case Kind.CAUSE:
            return (
                f"{_what(verdict.causes)} {_SMALL}"
                if before == after
                else f"{_what(verdict.causes)} "
                f"With that in the simulation, what it leaves unexplained falls from {before} of the data to {after}"
                + (
                    ", and that has another cause or none that this data tells."
                    if verdict.to_close is not None
                    else "."
                )
            )
        case Kind.AMBIGUOUS:
            return (
                f"These data show that something is missing, but not which of these it is: {_names(verdict)}. "
                f"Each of them explains what was left ({before} of the data before, {after} after). "
                f"To tell them apart: {verdict.experiment}"
            )
        case Kind.UNKNOWN if verdict.at_odds:
            return (
                "These recordings contradict themselves: their angles are not what their rates add up to. "
                "Until the clock, unit or gain behind it is mended, nothing fitted to them is to be trusted."
            )
        case Kind.UNKNOWN if not (verdict.causes or verdict.predicts):
            return (
                "The simulation explains short stretches of these data but does not predict whole runs: left to itself "
                "it ends far from what was measured. No effect that is known here explains why."
            )
        case Kind.UNKNOWN:
            return (
                f"The simulation is wrong in {before} of the data, and no effect that is known here explains why. "
                + _what_helps(verdict, after)
            )


def _what(causes: Sequence[Cause]) -> str:
    return " Besides: ".join(_matter(c) + (f" ({_where(c)})" if _where(c) else "") for c in causes)


def _matter(cause: Cause) -> str:
    """What is the matter, in one sentence; which way it is off where all that was found of it is off that way."""
    effect = effect_named(cause.addition.effect)
    pairs = zip(cause.trial.unknowns, cause.trial.amounts, strict=True)
    sizes = [amount for unknown, amount in pairs if unknown.name.startswith(f"{effect.name}.")]
    more, less = (bool(sizes) and all(sign * size > 0 for size in sizes) for sign in (1, -1))
    return effect.in_words_if_more * more or effect.in_words_if_less * less or effect.in_words


def _where(cause: Cause) -> str:
    """At which joints, in words; empty where it acts at all or at none in particular."""
    joints = cause.addition.joints
    if joints is None:
        return ""
    return f"joint{'s' if len(joints) > 1 else ''} {', '.join(str(joint + 1) for joint in joints)}"


def _names(verdict: Verdict) -> str:
    return "; ".join(dict.fromkeys(in_full(c) for c in (*verdict.causes, *verdict.alternatives)))


def in_full(cause: Cause) -> str:
    """An effect's name, where it acts, and in brackets what that means."""
    where = f" at {_where(cause)}" if _where(cause) else ""
    return f"{cause.addition.effect}{where} ({_matter(cause).rstrip('.')})"


def _what_helps(verdict: Verdict, after: str) -> str:
    helps = " with ".join(in_full(c) for c in verdict.causes)
    if not helps:
        return f"None even helps. {_NEXT}"
    if not verdict.predicts:
        told = "explains short stretches of them, yet it does not predict runs that it was not fitted to"
        return f"{helps} {told}. {_NEXT}"
    return f"{helps} helps, yet {after} stay unexplained. {_NEXT}"


def lookalikes_in_words(verdict: Verdict) -> list[str]:
    """What is no effect of the library and would look like those that are named."""
    named = () if verdict.kind is Kind.UNKNOWN else (*verdict.causes, *verdict.alternatives)
    effects = dict.fromkeys(cause.addition.effect for cause in named)
    return [f"{name}: {beware}" for name in effects if (beware := effect_named(name).beware)]


def worth_in_words(closed: float) -> str:
    """What the extension gains on runs that it was not fitted to."""
    if closed <= -_NOTICED:
        return "The extension predicts runs that it was not fitted to worse than the refitted model"
    if closed <= 0.0:
        return "The extension predicts runs that it was not fitted to no better"
    return f"The extension closes {100 * min(closed, 1.0):.0f} % of the distance to the noise"


def other_in_words(addition: Addition, closed: float) -> str:
    """What the best other effect would gain."""
    return f"The best other effect, {addition}, would close {100 * min(max(closed, 0.0), 1.0):.0f} % of it"


def scores_in_words(score: RunScore) -> dict[str, str]:
    """Eq. 19 of position and rate with their 95 % intervals."""
    return {
        "position": _with_interval(score.position, score.position_interval),
        "rate": _with_interval(score.rate, score.rate_interval),
    }


def _with_interval(score: float, interval: tuple[float, float]) -> str:
    low, high = interval
    return f"{score:.3f} ({low:.3f} to {high:.3f})" if math.isfinite(high) else f"{score:.3f}"


def cost_in_words(before: Sequence[RunScore], after: Sequence[RunScore]) -> str:
    """What the extension costs in simulation time."""
    once, now = (1e3 * float(np.median([score.seconds for score in scores])) for scores in (before, after))
    if round(once) == round(now):
        return f"simulating a run takes {now:.0f} ms, as before"
    return f"simulating a run takes {now:.0f} ms instead of {once:.0f} ms"


def identifiability_in_words(told: Identifiability) -> list[str]:
    """What the data tell of the parameters at all, and of which they do not."""
    closest = sorted(told.entangled, key=lambda pair: -abs(pair[2]))
    pairs = [f"{a} and {b} ({r:+.2f})" for a, b, r in closest[:_PAIRS]]
    more = f", and {len(closest) - _PAIRS} more pairs" * (len(closest) > _PAIRS)
    untold = [str(unknown) for unknown in told.untold]
    rank = f"{told.rank} directions among {len(told.unknowns)} unknowns"
    surest = f"; the surest is known {told.condition:,.0f} times as well as the least sure"
    lines = [f"The data tell of {rank} more than was known before{surest * (told.condition < _NOTHING_TOLD)}."]
    lines += [f"Estimates that hang together: {', '.join(pairs)}{more}."] if pairs else []
    lines += [f"Of these the data tell little: {', '.join(untold)}."] if untold else []
    return lines

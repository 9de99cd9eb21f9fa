"""The answer in plain words: verdict, causes, what stays unknown, and what to measure next."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from continuum.discovery.decision import Kind
from continuum.discovery.result import Cause, Diagnosis, Share, is_named
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.parameters import RATIO
from continuum.identification.estimate import Estimate
from continuum.identification.nrmse import nrmse

MORE_RUNS = "Record at least three more runs with other motions, each with the arm at rest at its beginning or end."

UNSTEADY = "Parts of the recordings disagree about the sizes of the effects: something else acts as well, or instead."
_NOTHING_MORE = "Nothing in them calls for a further effect."
_WITHIN_TOLERANCE = "An effect of the library would help, but the error is within the tolerance."


def verdict_in_words(result: Diagnosis) -> str:
    """Two or three sentences."""
    verdict = result.verdict
    match verdict.kind:
        case Kind.ADEQUATE:
            return (
                f"With springs and friction refitted, the simulation agrees with these recordings. {adequate(result)}"
            )
        case Kind.CAUSE:
            return f"{_matters(result.causes)} {_closes(result)} {_rest(result)}"
        case Kind.AMBIGUOUS:
            names = "; or ".join(" and ".join(map(in_full, causes)) or "nothing" for causes in result.sets)
            return (
                f"Something is missing, but these recordings cannot tell which: {names}. "
                f"To tell them apart: {_experiment(result)}{_unsteady(result)}"
            )
        case Kind.UNKNOWN if result.causes:
            helps = " with ".join(in_full(cause) for cause in result.causes)
            return (
                "The simulation misses something that no effect of the library explains. "
                f"{helps} helps most but leaves much unexplained: do not take it for the cause. {MORE_RUNS}"
            )
        case _:
            return f"The simulation misses something, and no effect of the library even helps. {MORE_RUNS}"


def adequate(result: Diagnosis) -> str:
    """How near the refitted model comes, and whether anything would help."""
    return f"{_error(result)} {_NOTHING_MORE if result.verdict.complete else _WITHIN_TOLERANCE}"


def in_full(cause: Cause) -> str:
    """An effect's name, where it acts, and in brackets what that means."""
    where = f" at {places(cause)}" if places(cause) else ""
    return f"{cause.effect}{where} ({matter_in_words(cause).rstrip('.')})"


def places(cause: Cause) -> str:
    """At which joints, in words; empty where it belongs to the whole arm."""
    if cause.joints is None:
        return ""
    return f"joint{'s' if len(cause.joints) > 1 else ''} {', '.join(str(joint + 1) for joint in cause.joints)}"


def matter_in_words(cause: Cause) -> str:
    """What is the matter; which way, where all sizes are off the same way."""
    effect = effect_named(cause.effect)
    if any("." not in one.name for one in cause.estimates):
        return effect.in_words_if_lacking
    sizes = [one.value for one in cause.estimates if not effect.parameters[one.name.split(".")[1]].default]
    more, less = (bool(sizes) and all(sign * size > 0 for size in sizes) for sign in (1, -1))
    return effect.in_words_if_more * more or effect.in_words_if_less * less or effect.in_words


def share_in_words(share: Share) -> str:
    """Percent with its interval."""
    if not math.isfinite(share.low):
        return f"{100 * share.value:.0f} %"
    return f"{100 * share.value:.0f} % ({100 * share.low:.0f} to {100 * share.high:.0f})"


def shares_in_words(result: Diagnosis) -> list[tuple[str, str]]:
    """Table of what each effect closes of the open-loop error, and of what stays unknown."""
    return [(name, share_in_words(share)) for name, share in result.shares.items()]


def sigma_in_words(result: Diagnosis) -> list[tuple[str, str]]:
    """Table of the missing torque at each joint, before and after."""
    before, after = (1e3 * sigma for sigma in result.sigma)
    arrow = [f"{b:.1f}" + f" -> {a:.1f}" * result.is_extended for b, a in zip(before, after, strict=True)]
    return [(f"joint {joint + 1}", f"{text} mN m") for joint, text in enumerate(arrow)]


def errors_in_words(result: Diagnosis) -> list[tuple[str, str]]:
    """Table of open-loop errors of every recording: root mean square, and Eq. 19."""
    rows = []
    for r, run in enumerate(result.recordings):
        models = [result.before, result.after] if result.is_extended else [result.before]
        degrees = " -> ".join(f"{np.degrees(one.error(r, run.theta)):.2f}" for one in models)
        scores = " -> ".join(f"{nrmse(one.angles[r], run.theta):.3f}" for one in models)
        rows.append((run.name, f"{degrees} deg   NRMSE {scores}"))
    return rows


def estimate_in_words(one: Estimate) -> str:
    """Value with its interval and unit."""
    interval = f" ({one.low:.4g} to {one.high:.4g})" if math.isfinite(one.low) else ""
    unit = f" {one.unit}" * (one.unit != "1")
    degrees = f" = {math.degrees(one.value):.3g} degrees" if one.unit == "rad" else ""
    percent = f" = {100 * one.value:+.3g} %" if one.meaning.endswith(RATIO) else ""
    return f"{one.value:.4g}{interval}{unit}{degrees}{percent}"


def similar_causes(result: Diagnosis) -> list[str]:
    """What is no effect of the library and would look like those that are named."""
    if not is_named(result.verdict.kind):
        return []
    named = dict.fromkeys(cause.effect for causes in result.sets for cause in causes)
    return [f"{name}: {beware}" for name in named if (beware := effect_named(name).beware)]


def _matters(causes: Sequence[Cause]) -> str:
    return " Besides: ".join(
        matter_in_words(cause) + (f" ({places(cause)})" if places(cause) else "") for cause in causes
    )


def _closes(result: Diagnosis) -> str:
    return (
        "Adding it to the simulation closes "
        f"{share_in_words(result.closed)} of the distance between its open-loop error and the sensors' noise."
    )


def _rest(result: Diagnosis) -> str:
    if result.verdict.complete:
        return "No further torque is missing beyond what any model leaves."
    return "Part of the error remains, and its cause is unknown." + _unsteady(result)


def _unsteady(result: Diagnosis) -> str:
    return "" if result.verdict.steady else f" {UNSTEADY}"


def _error(result: Diagnosis) -> str:
    worst = max(result.before.error(r, run.theta) for r, run in enumerate(result.recordings))
    pieces, whole, accepted = (np.degrees(x) for x in (result.before.of_segments, worst, result.tolerance))
    text = f"Half-second segments stay within {pieces:.2f} degrees of the measured angles, whole recordings within "
    text += f"{whole:.2f} (root mean square; tolerance {accepted:.2f})."
    return text + " Joints come to rest at other angles, which depends on friction near rest." * bool(whole > accepted)


def _experiment(result: Diagnosis) -> str:
    return " ".join(dict.fromkeys(effect_named(c.effect).experiment for causes in result.sets for c in causes))

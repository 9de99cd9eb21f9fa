"""The answer in plain words: verdict, causes, what stays unknown, and what to measure next."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from continuum.discovery.decision import Kind
from continuum.discovery.result import Cause, Diagnosis, Share, is_named
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.parameters import RATIO
from continuum.identification.estimate import Estimate
from continuum.identification.nrmse import nrmse
from continuum.languages import ENGLISH, Message, Translator
from continuum.significant_digits import rounded

MORE_RUNS = Message(
    "Record at least three more runs with other motions, each with the arm at rest at its beginning or end."
)
UNSTEADY = Message(
    "Parts of the recordings disagree about the sizes of the effects: something else acts as well, or instead."
)
_NOTHING_MORE = Message("Nothing in them calls for a further effect.")
_WITHIN_TOLERANCE = Message("An effect of the library would help, but the error is within the tolerance.")


def verdict_in_words(result: Diagnosis, tr: Translator = ENGLISH) -> str:
    """Two or three sentences."""
    verdict = result.verdict
    match verdict.kind:
        case Kind.ADEQUATE:
            agrees = tr("With springs and friction refitted, the simulation agrees with these recordings.")
            return f"{agrees} {adequate(result, tr)}"
        case Kind.CAUSE:
            return f"{_matters(result.causes, tr)} {_closes(result, tr)} {_rest(result, tr)}"
        case Kind.AMBIGUOUS:
            sets = (tr(" and ").join(in_full(one, tr) for one in causes) or tr("nothing") for causes in result.sets)
            return " ".join(
                [
                    tr(
                        "Something is missing, but these recordings cannot tell which: {sets}.",
                        sets=tr("; or ").join(sets),
                    ),
                    tr("To tell them apart: {experiment}", experiment=_experiment(result, tr)),
                    *_unsteady(result, tr),
                ]
            )
        case Kind.UNKNOWN if result.causes:
            return tr(
                "The simulation misses something that no effect of the library explains. "
                "{effects} helps most but leaves much unexplained: do not take it for the cause. {more_runs}",
                effects=tr(" with ").join(in_full(cause, tr) for cause in result.causes), more_runs=MORE_RUNS,
            )  # fmt: skip
        case _:
            misses = tr("The simulation misses something, and no effect of the library even helps.")
            return f"{misses} {tr(MORE_RUNS)}"


def adequate(result: Diagnosis, tr: Translator = ENGLISH) -> str:
    """How near the refitted model comes, and whether anything would help."""
    return f"{_error(result, tr)} {tr(_NOTHING_MORE if result.verdict.complete else _WITHIN_TOLERANCE)}"


def in_full(cause: Cause, tr: Translator = ENGLISH) -> str:
    """An effect's name, where it acts, and in brackets what that means."""
    matter, where = matter_in_words(cause, tr).rstrip("."), places(cause, tr)
    effect = tr("{effect} at {joints}", effect=cause.effect, joints=where) if where else cause.effect
    return f"{effect} ({matter})"


def places(cause: Cause, tr: Translator = ENGLISH) -> str:
    """At which joints, in words; empty where it belongs to the whole arm."""
    return "" if cause.joints is None else joints_in_words(cause.joints, tr)


def joints_in_words(joints: Sequence[int], tr: Translator = ENGLISH) -> str:
    """Joints, given from 0, in words."""
    numbers = ", ".join(str(joint + 1) for joint in joints)
    return tr.plural("joint {joints}", "joints {joints}", len(joints), joints=numbers)


def matter_in_words(cause: Cause, tr: Translator = ENGLISH) -> str:
    """What is the matter; which way, where all sizes are off the same way."""
    effect = effect_named(cause.effect)
    if any("." not in one.name for one in cause.estimates):
        return tr(effect.in_words_if_lacking)
    sizes = [one.value for one in cause.estimates if not effect.parameters[one.name.split(".")[1]].default]
    more, less = (bool(sizes) and all(sign * size > 0 for size in sizes) for sign in (1, -1))
    return tr(effect.in_words_if_more * more or effect.in_words_if_less * less or effect.in_words)


def share_in_words(share: Share, tr: Translator = ENGLISH) -> str:
    """Percent with its interval."""
    if not math.isfinite(share.low):
        return f"{100 * share.value:.0f} %"
    low, high = 100 * share.low, 100 * share.high
    return tr("{share:.0f} % ({low:.0f} to {high:.0f})", share=100 * share.value, low=low, high=high)


def shares_in_words(result: Diagnosis, tr: Translator = ENGLISH) -> list[tuple[str, str]]:
    """Table of what each effect closes of the open-loop error, and of what stays unknown."""
    *found, (_, rest) = result.shares.items()
    return [*((name, share_in_words(share, tr)) for name, share in found), (tr("unknown"), share_in_words(rest, tr))]


def sigma_in_words(result: Diagnosis, tr: Translator = ENGLISH) -> list[tuple[str, str]]:
    """Table of the missing torque at each joint, before and after."""
    before, after = (1e3 * sigma for sigma in result.sigma)
    arrow = [f"{b:.1f}" + f" -> {a:.1f}" * result.is_extended for b, a in zip(before, after, strict=True)]
    return [(joints_in_words([joint], tr), f"{text} mN m") for joint, text in enumerate(arrow)]


def errors_in_words(result: Diagnosis, tr: Translator = ENGLISH) -> list[tuple[str, str]]:
    """Table of open-loop errors of every recording: root mean square, and Eq. 19."""
    rows = []
    for r, run in enumerate(result.recordings):
        models = [result.before, result.after] if result.is_extended else [result.before]
        degrees = " -> ".join(f"{np.degrees(one.error(r, run.theta)):.2f}" for one in models)
        scores = " -> ".join(f"{nrmse(one.angles[r], run.theta):.3f}" for one in models)
        rows.append((run.name, tr("{error} deg   NRMSE {nrmse}", error=degrees, nrmse=scores)))
    return rows


def estimate_name(one: Estimate, tr: Translator = ENGLISH) -> str:
    """The name that files have for a value, and its recording where each has its own."""
    name = str(replace(one, recording=""))
    return tr("{value} in {recording}", value=name, recording=one.recording) if one.recording else name


def estimate_in_words(one: Estimate, tr: Translator = ENGLISH) -> str:
    """Value with its interval and unit."""
    low, high = rounded(one.low, 4), rounded(one.high, 4)
    interval = " " + tr("({low} to {high})", low=low, high=high) if math.isfinite(one.low) else ""
    unit = f" {one.unit}" * (one.unit != "1")
    degrees = " " + tr("= {angle} degrees", angle=rounded(math.degrees(one.value), 3)) if one.unit == "rad" else ""
    percent = f" = {rounded(100 * one.value, 3, '+')} %" if one.meaning.endswith(RATIO) else ""
    return f"{rounded(one.value, 4)}{interval}{unit}{degrees}{percent}"


def similar_causes(result: Diagnosis, tr: Translator = ENGLISH) -> list[str]:
    """What is no effect of the library and would look like those that are named."""
    if not is_named(result.verdict.kind):
        return []
    named = dict.fromkeys(cause.effect for causes in result.sets for cause in causes)
    return [f"{name}: {tr(beware)}" for name in named if (beware := effect_named(name).beware)]


def known_in_words(result: Diagnosis, tr: Translator = ENGLISH) -> str:
    """What the answer rests on besides the recordings, one sentence; empty where nothing."""
    return tr("Also known: {facts}.", facts="; ".join(map(tr, result.known))) if result.known else ""


def _matters(causes: Sequence[Cause], tr: Translator) -> str:
    first, *others = (
        matter_in_words(cause, tr) + (f" ({places(cause, tr)})" if places(cause, tr) else "") for cause in causes
    )
    return " ".join([first, *(tr("Besides: {matter}", matter=matter) for matter in others)])


def _closes(result: Diagnosis, tr: Translator) -> str:
    share = share_in_words(result.closed, tr)
    return tr.plural(
        "Adding this effect to the model removes {share} of the open-loop error above sensor noise.",
        "Adding these effects to the model removes {share} of the open-loop error above sensor noise.",
        len(result.causes), share=share,
    )  # fmt: skip


def _rest(result: Diagnosis, tr: Translator) -> str:
    if result.verdict.complete:
        return tr("The remaining error is no larger than expected of a complete model.")
    return " ".join([tr("Part of the error remains, and its cause is unknown."), *_unsteady(result, tr)])


def _unsteady(result: Diagnosis, tr: Translator) -> list[str]:
    return [] if result.verdict.steady else [tr(UNSTEADY)]


def _error(result: Diagnosis, tr: Translator) -> str:
    worst = max(result.before.error(r, run.theta) for r, run in enumerate(result.recordings))
    pieces, whole, accepted = (np.degrees(x) for x in (result.before.of_segments, worst, result.tolerance))
    text = tr(
        "Half-second segments stay within {segments:.2f} degrees of the measured angles, whole recordings within "
        "{whole:.2f} (root mean square; tolerance {tolerance:.2f}).",
        segments=pieces, whole=whole, tolerance=accepted,
    )  # fmt: skip
    if not whole > accepted:
        return text
    return f"{text} {tr('Joints come to rest at other angles, which depends on friction near rest.')}"


def _experiment(result: Diagnosis, tr: Translator) -> str:
    named = dict.fromkeys(effect_named(c.effect).experiment for causes in result.sets for c in causes)
    return " ".join(map(tr, named))

"""Sentences of the page of a diagnosis: title, verdict, warnings, how often that is right."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from continuum.discovery.decision import Kind
from continuum.discovery.report.matter import matter_with_value
from continuum.discovery.report.names import capital, effect_in_words, label_in_words, listed, sets_in_words, small
from continuum.discovery.report.power_tables import counts
from continuum.discovery.report.quantities import percent, percent_interval
from continuum.discovery.report.tables import error_rows, joint_rows
from continuum.discovery.report.track_record import track_record
from continuum.discovery.result import Cause, Diagnosis, is_named
from continuum.discovery.words import UNSTEADY, adequate
from continuum.dynamics.effect_lookup import effect_named

_RIGHT: Final = {
    Kind.ADEQUATE: "nothing was wrong with {} arms; the others had a hidden fault that did not show",
    Kind.CAUSE: "{} named only faults that were really there",
    Kind.AMBIGUOUS: "{} listed exactly the hidden faults as one possibility",
    Kind.UNKNOWN: "{} arms had a fault that the library lacks; the others had one that it has, or none",
}
_IN_A_TITLE: Final = 3
"""Explanations that a title lists."""


def title(result: Diagnosis, contradictions: Sequence[str]) -> str:
    """The verdict in a few words.

    Args:
        result: the answer.
        contradictions: `odd_rates` of its recordings.
    """
    match result.verdict.kind:
        case Kind.ADEQUATE:
            return "The simulation agrees with the recordings"
        case Kind.CAUSE:
            return f"Cause: {extension(result)}"
        case Kind.AMBIGUOUS if len(result.sets) <= _IN_A_TITLE:
            names, common = sets_in_words(
                [[cause.label for cause in causes] for causes in result.sets], result.n_joints
            )
            return f"Not decided: {', or '.join(names)}" + f"; in any case {common}" * bool(common)
        case Kind.AMBIGUOUS:
            return f"Not decided: {len(result.sets)} explanations fit"
        case _ if contradictions:
            return "The recordings contradict themselves"
        case _:
            return "Something is missing, and its cause is unknown"


def verdict_sentence(result: Diagnosis, contradictions: Sequence[str]) -> str:
    """The verdict in one sentence; arguments as of `title`."""
    match result.verdict.kind:
        case Kind.ADEQUATE:
            return f"With springs and friction refitted, {small(adequate(result))}"
        case Kind.CAUSE:
            matters = capital("; ".join(small(matter_with_value(cause)) for cause in result.causes))
            rest = "nothing more is missing" if result.verdict.complete else "the cause of the rest is unknown"
            return f"{matters}; adding this to the simulation removes {_closed(result)}, and {rest}."
        case Kind.AMBIGUOUS:
            return "Something is missing, and these recordings cannot tell which of the explanations below is right."
        case _ if contradictions:
            return "Angles and rates in these recordings do not belong to one motion, so no cause can be named."
        case _ if result.causes:
            return (
                "The simulation misses something that no effect of the library explains; what helps most "
                f"({extension(result)}) is not to be taken for the cause."
            )
        case _:
            return "The simulation misses something, and no effect of the library even helps."


def reliability(result: Diagnosis) -> str:
    """How often such a verdict is right, one sentence; empty where nobody knows, as with what hands measured."""
    record = track_record(result.verdict.kind)
    if record is None or result.known:
        return ""
    interval = percent_interval(record.low, record.high)
    right = _RIGHT[result.verdict.kind].format(record.right)
    arms = f"of {record.n} verdicts of this kind on simulated arms whose faults are known,"
    if result.verdict.kind is Kind.UNKNOWN:
        return f"How far to trust this: {arms} {right}."
    return f"How far to trust this: {arms} {right} ({percent(record.right / record.n)} %, 95 % interval {interval} %)."


def by_hand(result: Diagnosis) -> str:
    """What the verdict rests on besides the recordings, one sentence; empty where nothing."""
    return f"Also known: {'; '.join(result.known)}." if result.known else ""


def power_sentence(result: Diagnosis) -> str:
    """How much of the library these recordings can show."""
    shown, asked = counts(result)
    if not asked:
        return ""
    found = f"{shown or 'none'} would have been found at their typical sizes"
    return f"Of {asked} further effects that were tried, {found}."


def warnings(result: Diagnosis, contradictions: Sequence[str]) -> list[str]:
    """What speaks against the verdict or the extended model, a sentence each; arguments as of `title`."""
    runs, joints = ([row.name for row in rows if row.is_worse] for rows in (error_rows(result), joint_rows(result)))
    worse = [
        f"The extended model is farther from the measured angles than the refitted one {where} {listed(names)}."
        for where, names in (("in", runs), ("at", joints))
        if names
    ]
    unsteady = [UNSTEADY] * (is_named(result.verdict.kind) and not result.verdict.steady)
    return [*(capital(sentence) + "." for sentence in contradictions), *unsteady, *worse]


def extension(result: Diagnosis) -> str:
    """What the extended model has that the refitted one has not; empty where it is none."""
    return listed([_name(result, cause) for cause in result.causes])


def similar_causes(result: Diagnosis) -> list[str]:
    """What is no effect of the library and would look like those that are named."""
    if not is_named(result.verdict.kind):
        return []
    named = dict.fromkeys(cause.effect for causes in result.sets for cause in causes)
    warned = {effect_in_words(effect): effect_named(effect).beware for effect in named}
    return [f"{capital(name)}: {small(beware)}" for name, beware in warned.items() if beware]


def _closed(result: Diagnosis) -> str:
    interval = percent_interval(result.closed.low, result.closed.high)
    more = "" if interval in ("–", percent(result.closed.value)) else f" (95 % interval {interval} %)"
    return f"{percent(result.closed.value)} %{more} of its error above the sensors' noise"


def _name(result: Diagnosis, cause: Cause) -> str:
    return label_in_words(cause.label, result.n_joints)

"""Sentences of the page of a diagnosis: title, verdict, warnings, how often that is right."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from continuum.discovery.decision import Kind
from continuum.discovery.report.cause_sentences import matter_with_value
from continuum.discovery.report.names import capital, effect_in_words, label_in_words, listed, sets_in_words, small
from continuum.discovery.report.power_tables import counts
from continuum.discovery.report.quantities import percent, percent_interval
from continuum.discovery.report.tables import error_rows, joint_rows
from continuum.discovery.report.track_record import track_record
from continuum.discovery.result import Diagnosis, is_named
from continuum.discovery.words import UNSTEADY, adequate, known_in_words
from continuum.dynamics.effect_lookup import effect_named
from continuum.languages import Message, Translator

_RIGHT: Final = {
    Kind.ADEQUATE: Message(
        "How far to trust this: of {n} verdicts of this kind on simulated arms whose faults are known, nothing was "
        "wrong with {right} arms; the others had a hidden fault that did not show ({percent} %, 95 % interval "
        "{interval} %)."
    ),
    Kind.CAUSE: Message(
        "How far to trust this: of {n} verdicts of this kind on simulated arms whose faults are known, {right} named "
        "only faults that were really there ({percent} %, 95 % interval {interval} %)."
    ),
    Kind.AMBIGUOUS: Message(
        "How far to trust this: of {n} verdicts of this kind on simulated arms whose faults are known, {right} listed "
        "exactly the hidden faults as one possibility ({percent} %, 95 % interval {interval} %)."
    ),
    Kind.UNKNOWN: Message(
        "How far to trust this: of {n} verdicts of this kind on simulated arms whose faults are known, {right} arms "
        "had a fault that the library lacks; the others had one that it has, or none."
    ),
}
_IN_A_TITLE: Final = 3
"""Explanations that a title lists."""


def title(result: Diagnosis, contradictions: Sequence[str], tr: Translator) -> str:
    """The verdict in a few words.

    Args:
        result: the answer.
        contradictions: `odd_rates` of its recordings.
        tr: of the page.
    """
    match result.verdict.kind:
        case Kind.ADEQUATE:
            return tr("The simulation agrees with the recordings")
        case Kind.CAUSE:
            return tr("Cause: {effects}", effects=extension(result, tr))
        case Kind.AMBIGUOUS if len(result.sets) <= _IN_A_TITLE:
            labels = [[cause.label for cause in causes] for causes in result.sets]
            names, common = sets_in_words(labels, result.n_joints, tr)
            text = tr("Not decided: {sets}", sets=tr(", or ").join(names))
            return tr("{verdict}; in any case {effects}", verdict=text, effects=common) if common else text
        case Kind.AMBIGUOUS:
            return tr("Not decided: {count} explanations fit", count=len(result.sets))
        case _ if contradictions:
            return tr("The recordings contradict themselves")
        case _:
            return tr("Something is missing, and its cause is unknown")


def verdict_sentence(result: Diagnosis, contradictions: Sequence[str], tr: Translator) -> str:
    """The verdict in one sentence; arguments as of `title`."""
    match result.verdict.kind:
        case Kind.ADEQUATE:
            return tr("With springs and friction refitted, {finding}", finding=small(adequate(result, tr)))
        case Kind.CAUSE:
            matters = capital("; ".join(small(matter_with_value(cause, tr)) for cause in result.causes))
            if result.verdict.complete:
                return tr(
                    "{matters}; adding this to the simulation removes {share} of its error above the sensors' noise, "
                    "and nothing more is missing.",
                    matters=matters, share=_closed(result, tr),
                )  # fmt: skip
            return tr(
                "{matters}; adding this to the simulation removes {share} of its error above the sensors' noise, and "
                "the cause of the rest is unknown.",
                matters=matters, share=_closed(result, tr),
            )  # fmt: skip
        case Kind.AMBIGUOUS:
            return tr(
                "Something is missing, and these recordings cannot tell which of the explanations below is right."
            )
        case _ if contradictions:
            return tr("Angles and rates in these recordings do not belong to one motion, so no cause can be named.")
        case _ if result.causes:
            return tr(
                "The simulation misses something that no effect of the library explains; what helps most ({effects}) "
                "is not to be taken for the cause.",
                effects=extension(result, tr),
            )
        case _:
            return tr("The simulation misses something, and no effect of the library even helps.")


def reliability(result: Diagnosis, tr: Translator) -> str:
    """How often such a verdict is right, one sentence; empty where nobody knows, as with what hands measured."""
    record = track_record(result.verdict.kind)
    if record is None or result.known:
        return ""
    return tr(
        _RIGHT[result.verdict.kind], n=record.n, right=record.right, percent=percent(record.right / record.n, tr),
        interval=percent_interval(record.low, record.high, tr),
    )  # fmt: skip


def by_hand(result: Diagnosis, tr: Translator) -> str:
    """What the verdict rests on besides the recordings, one sentence; empty where nothing."""
    return known_in_words(result, tr)


def power_sentence(result: Diagnosis, tr: Translator) -> str:
    """How much of the library these recordings can show."""
    shown, asked = counts(result)
    if not asked:
        return ""
    if not shown:
        return tr(
            "Of {asked} further effects that were tried, none would have been found at their typical sizes.",
            asked=asked,
        )
    return tr.plural(
        "Of {asked} further effects that were tried, {shown} would have been found at their typical sizes.",
        "Of {asked} further effects that were tried, {shown} would have been found at their typical sizes.",
        shown, asked=asked, shown=shown,
    )  # fmt: skip


def warnings(result: Diagnosis, contradictions: Sequence[str], tr: Translator) -> list[str]:
    """What speaks against the verdict or the extended model, a sentence each; arguments as of `title`."""
    rows = error_rows(result), joint_rows(result, tr)
    runs, joints = (listed([row.name for row in table if row.is_worse], tr) for table in rows)
    found = [capital(tr(sentence)) + "." for sentence in contradictions]
    if is_named(result.verdict.kind) and not result.verdict.steady:
        found.append(tr(UNSTEADY))
    if runs:
        found.append(
            tr(
                "The extended model is farther from the measured angles than the refitted one in {recordings}.",
                recordings=runs,
            )
        )
    if joints:
        found.append(
            tr(
                "The extended model is farther from the measured angles than the refitted one at {joints}.",
                joints=joints,
            )
        )
    return found


def extension(result: Diagnosis, tr: Translator) -> str:
    """What the extended model has that the refitted one has not; empty where it is none."""
    return listed([label_in_words(cause.label, result.n_joints, tr) for cause in result.causes], tr)


def similar_causes(result: Diagnosis, tr: Translator) -> list[str]:
    """What is no effect of the library and would look like those that are named."""
    if not is_named(result.verdict.kind):
        return []
    named = dict.fromkeys(cause.effect for causes in result.sets for cause in causes)
    warned = {effect_in_words(effect, tr=tr): effect_named(effect).beware for effect in named}
    return [f"{capital(name)}: {small(tr(beware))}" for name, beware in warned.items() if beware]


def _closed(result: Diagnosis, tr: Translator) -> str:
    share, interval = percent(result.closed.value, tr), percent_interval(result.closed.low, result.closed.high, tr)
    if interval in ("–", share):
        return f"{share} %"
    return tr("{share} % (95 % interval {interval} %)", share=share, interval=interval)

"""What to do next: a measurement by hand, or a further run."""

from __future__ import annotations

from typing import Final, NamedTuple

from continuum.discovery.decision import Kind
from continuum.discovery.power_words import RECORD_AGAIN, option, repeated
from continuum.discovery.report.names import capital, effect_in_words, label_in_words, listed
from continuum.discovery.result import Cause, Diagnosis, Experiment, Removal
from continuum.discovery.words import MORE_RUNS
from continuum.dynamics.effect_lookup import effect_named
from continuum.languages import ENGLISH, Message, Translator

_LISTED: Final = 4
"""Effects that the first screen lists."""


class Step(NamedTuple):
    """Something to do, its purpose in a sentence, and the option with which to diagnose again; both may be empty."""

    instruction: str
    purpose: str
    option: str = ""


_REPEAT: Final = Message("Repeat one of these runs three times, without touching anything in between.")
_WHY_REPEAT: Final = Message(
    "Shows whether the cause changes from run to run: segments of the recordings disagree about its size."
)


class ExperimentRow(NamedTuple):
    """An experiment, whether it separates the explanations, and what else it shows."""

    name: str
    instruction: str
    separates: str
    shows: str


def next_steps(result: Diagnosis, tr: Translator = ENGLISH) -> list[Step]:
    """Return what to do next, the best first."""
    by_hand = [
        Step(
            tr(effect_named(c.effect).experiment),
            tr("Tests: {effect}.", effect=label_in_words(c.label, result.n_joints, tr)),
        )
        for c in _in_doubt(result)
    ]
    steps = [Step(tr(one.instruction), would_show(result, one, tr, _LISTED)) for one in result.experiments]
    repeating = [] if result.verdict.steady else [Step(tr(_REPEAT), tr(_WHY_REPEAT))]
    telling = [step for step in steps if step.purpose]
    match result.verdict.kind:
        case Kind.ADEQUATE:
            return telling[:1]
        case Kind.CAUSE:
            return [*by_hand, *repeating]
        case Kind.AMBIGUOUS:
            named = getattr(result.separating, "effect", None)
            others = [step for step, c in zip(by_hand, _in_doubt(result), strict=True) if c.effect != named]
            return [*_separating(result, tr), *others, *repeating]
        case _:
            return [Step(tr(MORE_RUNS), ""), *telling[:1]]


def would_show(result: Diagnosis, one: Experiment, tr: Translator, most: int | None = None) -> str:
    """Say what an experiment would show that these recordings cannot; empty if nothing.

    Args:
        result: the answer; effects of its sets are shown already.
        one: the experiment.
        tr: of the page.
        most: most effects to list; all if None.
    """
    named, places = {cause.label for causes in result.sets for cause in causes}, dict[str, set[int]]()
    for label in one.shows:
        effect, _, where = label.partition("@")
        if label not in named:
            places.setdefault(effect, set()).update(int(joint) - 1 for joint in where.split(",") if joint)
    names = [effect_in_words(effect, sorted(at) or None, result.n_joints, tr) for effect, at in places.items()]
    left = len(names[most:]) if most else 0
    shown = [*names[:most], tr("{count} more", count=left)] if left else names
    return tr("It would show: {effects}.", effects=listed(shown, tr)) if names else ""


def experiment_rows(result: Diagnosis, tr: Translator) -> list[ExperimentRow]:
    """Return all experiments, the best first."""
    return [
        ExperimentRow(capital(tr(one.name)), tr(one.instruction), _separates(one, tr), would_show(result, one, tr))
        for one in result.experiments
    ]


def _separates(one: Experiment, tr: Translator) -> str:
    return tr.plural("after {runs} run", "after {runs} runs", one.runs, runs=one.runs) if one.runs else tr("no")


def _separating(result: Diagnosis, tr: Translator) -> list[Step]:
    """Return the step that distinguishes the explanations, if there is one."""
    purpose = tr("Distinguishes the explanations.")
    match result.separating:
        case None:
            return []
        case Experiment() as run:
            return [Step(repeated(run, tr), purpose)]
        case Removal() as removal:
            command = f"--without {removal.effect}"
            return [Step(f"{tr(removal.instruction)} {tr(RECORD_AGAIN)}", purpose, command)]
        case test:
            return [Step(tr(test.instruction), purpose, option(test, tr))]


def _in_doubt(result: Diagnosis) -> list[Cause]:
    """Return the effects that some sets have and others lack; with a single set, all of its effects."""
    sets = [{cause.label for cause in causes} for causes in result.sets]
    common = set.intersection(*sets) if len(sets) > 1 else set[str]()
    every = [cause for causes in result.sets for cause in causes if cause.label not in common]
    return list({cause.effect: cause for cause in reversed(every)}.values())[::-1]

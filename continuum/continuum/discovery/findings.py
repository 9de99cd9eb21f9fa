"""All that a diagnosis has to tell: verdict, values with intervals, gain on held-out runs, the extended model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import Addition
from continuum.discovery.confirmation import confirmed, contradicted
from continuum.discovery.diagnose import Diagnosis
from continuum.discovery.evidence import gain
from continuum.discovery.in_words import lookalikes_in_words
from continuum.discovery.measured_gain import RunScore, held_out_scores, told_gap
from continuum.discovery.question import Question
from continuum.discovery.trial import Trial, fit_extension
from continuum.discovery.verdict import Cause, Kind, Verdict
from continuum.dynamics.model import Model
from continuum.identification.bootstrap import bootstrap, interval
from continuum.identification.dataset import halves
from continuum.identification.fisher import Identifiability, identifiability
from continuum.identification.fit import THESIS_PARAMETERS, Fit
from continuum.identification.free import Free
from continuum.identification.rate_ratio import odd_rates
from continuum.recordings.recording import Recording

_ITERATIONS = 8
_NEAR = 1e-3  # to a limit, of a value
_SIMULATED = ("the rates are quieter than any sensor's: taken for simulated, and for known to 0.5 deg/s",)
_WAYS = {
    True: "to hold until their next row, as commands do",
    False: "to change evenly from row to row, as measured ones do",
}


@dataclass(frozen=True)
class Estimate:
    """One fitted value.

    Attributes:
        unknown: which.
        value: in its unit.
        low, high: 95 % interval.
        unit: SI.
        at_limit: whether it is as small or as large as it may be, or its interval reaches there.
    """

    unknown: Free
    value: float
    low: float
    high: float
    unit: str
    at_limit: bool = False


@dataclass(frozen=True)
class Other:
    """The best effect that is not named, beside those that are.

    Attributes:
        addition: what it is.
        closed: part of the distance to the noise floor that it closes instead of the first cause.
    """

    addition: Addition
    closed: float


@dataclass(frozen=True)
class Findings:
    """What reports show.

    Attributes:
        verdict: the answer.
        estimates: of the thesis's parameters and of the effects'.
        others: for each alternative, the estimates of its own effect.
        identifiability: what the data tell of them.
        before, after: every run predicted by the other half, by the refitted and by the extended model.
        closed: part of the distance to the noise floor that the extension closes.
        weakness: why this proves less than it would with more runs; empty where it does not.
        notes: on repairs of the data, how tensions were taken, and what the model leaves out.
        refitted, model: the model as it was and the extended one, both fitted to all runs.
        models: the latter as it is in each run, with what that run has for itself.
        other: what the best other effect would gain; none where nothing is named, or nothing else promised anything.
    """

    verdict: Verdict
    estimates: tuple[Estimate, ...]
    others: tuple[tuple[Estimate, ...], ...]
    identifiability: Identifiability
    before: tuple[RunScore, ...]
    after: tuple[RunScore, ...]
    closed: float
    weakness: str
    notes: tuple[str, ...]
    refitted: Model
    model: Model
    models: tuple[Model, ...]
    other: Other | None = None


def findings(diagnosis: Diagnosis, random: np.random.Generator) -> Findings:
    """Work them out.

    Args:
        diagnosis: what was found.
        random: for the intervals.
    """
    question, split = diagnosis.question, halves(diagnosis.question.recordings)
    baseline, best = diagnosis.verdict.baseline, diagnosis.verdict.best
    before = held_out_scores(question, baseline, split, random)
    after = held_out_scores(question, best, split, random) if best.extension else before
    odd = odd_rates(question.recordings)
    other = best_other(diagnosis)
    beside = held_out_scores(question, other, split, random) if other else []
    verdict = confirmed(diagnosis.verdict, before, after, beside)
    verdict = contradicted(verdict) if odd else verdict
    after = after if verdict.extension else before
    fitted = fit_extension(question, verdict.extension, verdict.best, _ITERATIONS, to_the_end=True)
    return Findings(
        verdict,
        tuple(_estimates(fitted, random)),
        tuple(tuple(_of_alternative(question, rival, random)) for rival in verdict.alternatives),
        identifiability(fitted),
        tuple(as_given(before, question.recordings)),
        tuple(as_given(after, question.recordings)),
        told_gap(before, after),
        split.weakness,
        tuple(f"{r.name}: {note}" for r in question.recordings for note in r.notes)
        + _rows_told(question)
        + (_SIMULATED * question.noise.is_simulated)
        + tuple(odd)
        + _left_out(verdict)
        + tuple(lookalikes_in_words(verdict)),
        fit_extension(question, (), verdict.baseline, 2).model,
        _told(fitted, [r.name for r in question.recordings]),
        tuple(fitted.model_of(number) for number in range(len(question.recordings))),
        Other(other.extension[-1], told_gap(before, beside)) if other and verdict.kind is Kind.CAUSE else None,
    )


def best_other(diagnosis: Diagnosis) -> Trial | None:
    """Of the effects that stood beside the first cause the one that gained most, where a cause may be named."""
    verdict = diagnosis.verdict
    if verdict.kind is not Kind.CAUSE and verdict.to_close is None:
        return None
    named = {cause.addition.effect for cause in verdict.causes}
    first = next(one for one in diagnosis.rounds if one.best is not one.before)
    others = [trial for trial in first.leaders if trial.extension[-1].effect not in named]
    return max(others, key=lambda trial: gain(trial, first.before).log_likelihood, default=None)


def as_given(scores: Sequence[RunScore], recordings: Sequence[Recording]) -> list[RunScore]:
    """In the order in which recordings were given; parts of a single one as they come."""
    place = {recording.name: number for number, recording in enumerate(recordings)}
    return sorted(scores, key=lambda score: place.get(score.name, 0))


def _rows_told(question: Question) -> tuple[str, ...]:
    """How tensions were taken to go on between rows, where any were measured."""
    ways = {run.tensions.held for run in question.recordings if run.is_driven and run.tensions is not None}
    return tuple(f"cable tensions are taken {_WAYS[held]}" for held in sorted(ways))


def _left_out(verdict: Verdict) -> tuple[str, ...]:
    """What was fitted and the extended model does not have."""
    own = sorted({unknown.name for unknown in verdict.best.unknowns if unknown.recording is not None})
    return (
        (f"{', '.join(own)}: each recording has its own, so that a model file cannot hold it and leaves it at zero",)
        if own
        else ()
    )


def _of_alternative(question: Question, rival: Cause, random: np.random.Generator) -> list[Estimate]:
    fitted = fit_extension(question, rival.trial.extension, rival.trial, _ITERATIONS, to_the_end=True)
    return [e for e in _estimates(fitted, random) if e.unknown.name.startswith(rival.addition.effect + ".")]


def _estimates(fitted: Fit, random: np.random.Generator) -> list[Estimate]:
    low, high = interval(bootstrap(fitted, random))
    meanings, origin = fitted.model.meanings(), fitted.simulator.model.values()
    found = []
    amounts = fitted.space.scale * fitted.coordinates
    for i, unknown in enumerate(fitted.space.unknowns):
        if "." not in unknown.name and (unknown.name not in THESIS_PARAMETERS or unknown.joint is not None):
            continue
        nominal = float(_entry(origin[unknown.name], unknown.joint))
        value, least, most = (nominal + float(added[i]) for added in (amounts, low, high))
        meaning = meanings[unknown.name]
        near = _NEAR * max(abs(value), meaning.typical or abs(nominal))
        at_limit = least <= meaning.lower + near or most >= meaning.upper - near
        found.append(Estimate(unknown, value, least, most, meaning.unit, at_limit))
    return found


def _entry(values: Array, joint: int | None) -> float:
    return float(values[joint or 0])


def _told(fitted: Fit, names: Sequence[str]) -> Model:
    """The fitted model with the source of what the fit has changed."""
    source = "identified from " + ", ".join(names)
    before, after = fitted.simulator.model.values(), fitted.model.values()
    changed = {name: source for name in after if not np.allclose(before[name], after[name], rtol=1e-9, atol=0.0)}
    return replace(fitted.model, sources=dict(fitted.simulator.model.sources) | changed)

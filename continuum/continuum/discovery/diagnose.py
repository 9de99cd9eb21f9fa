"""Given data, what does the simulation get wrong: noise, baseline, search, verdict."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

from continuum.discovery.judgement import judge
from continuum.discovery.question import Question
from continuum.discovery.round import Round
from continuum.discovery.rows_asked_again import with_better_rows
from continuum.discovery.search import Earlier, Tell, search, tell_nobody, until_the_end
from continuum.discovery.special_cases import worth_trying
from continuum.discovery.trial import TOLERANCES, Trial
from continuum.discovery.verdict import Verdict
from continuum.discovery.workers import workers
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.model import Model
from continuum.dynamics.simulator import Simulator
from continuum.errors import InvalidValueError
from continuum.identification.arrow_least_squares import FitStatus
from continuum.identification.baseline import baseline_unknowns, with_dry_friction
from continuum.identification.dataset import Dataset
from continuum.identification.noise import SensorKnowledge, estimate_noise
from continuum.identification.tension_rows import with_likelier_rows


@dataclass(frozen=True)
class Diagnosis:
    """The verdict and how it was reached."""

    question: Question
    rounds: tuple[Round, ...]
    verdict: Verdict


def diagnose(
    dataset: Dataset,
    model: Model,
    known: SensorKnowledge | None = None,
    processes: int | None = None,
    tell: Tell = tell_nobody,
    effects: Sequence[str] | None = None,
) -> Diagnosis:
    """Diagnose a model by data.

    Args:
        dataset: runs of the arm.
        model: with nominal values.
        known: of the sensors.
        processes: how many work at once; as many as there are cores without.
        tell: told of progress.
        effects: names of those to try; all that are installed without.

    Raises:
        InvalidValueError: the recordings have another number of joints than the model, an effect is not installed, or
            no model can be simulated from what was measured.
    """
    if processes is not None and processes < 1:
        raise InvalidValueError("processes", processes, "1 or more")
    if dataset.n_joints != model.n_joints:
        name = dataset.recordings[0].name
        raise InvalidValueError(f"joints of {name}", dataset.n_joints, f"{model.n_joints}, as the model has")
    ready = with_dry_friction(model)
    noise = estimate_noise(dataset.recordings, known)
    unknowns = tuple(baseline_unknowns(ready))
    driven = any(recording.is_driven for recording in dataset.recordings)
    if driven:
        tell("how tensions go on between rows", 0.0)
    recordings = with_likelier_rows(Simulator(ready, TOLERANCES), dataset.recordings, noise, unknowns)
    question = Question(ready, unknowns, recordings, noise)
    present = {active.effect.name for active in model.effects}
    asked = [name for name in (effect_names() if effects is None else effects) if name not in present]
    asked = worth_trying(asked, len(recordings))
    tried = [name for name in asked if driven or not effect_named(name).needs_tension]

    question, rounds, verdict = _answered(question, tried, processes or os.cpu_count() or 1, tell, driven)
    if verdict.best.status is FitStatus.NO_SIMULATION:
        raise InvalidValueError("model", verdict.best.status.value, "one that moves from the angles that were measured")
    return Diagnosis(question, tuple(rounds), verdict)


def _answered(
    question: Question, tried: Sequence[str], processes: int, tell: Tell, asks: bool, earlier: Earlier | None = None
) -> tuple[Question, list[Round], Verdict]:
    """The question, with its tensions between rows the other way where a search's best is better so, and the answer."""
    others: list[tuple[Question, Trial]] = []

    def is_other(best: Trial) -> bool:
        tell("how tensions go on between rows, asked again", 1.0)
        other = with_better_rows(question, best)
        others.extend([] if other is None else [other])
        return other is not None

    with workers(question, processes) as make:
        baseline, rounds = search(make, tried, tell, is_other if asks else until_the_end, earlier)
    if others:
        other, best = others[0]
        return _answered(other, tried, processes, tell, asks=False, earlier=Earlier(baseline, best))
    return question, rounds, judge(baseline, rounds)

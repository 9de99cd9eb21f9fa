"""What an extension is worth: free simulation of runs that neither model was fitted to, before and after (Table 4).

An arm that sticks and slips forgets nothing: of two models that no window tells apart one slips where the other sticks,
and from there on their free runs go apart. So far off, a prediction says nothing against its model.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from continuum.discovery.candidate import extended
from continuum.discovery.question import Question
from continuum.discovery.trial import TOLERANCES, Trial, fit_extension
from continuum.dynamics.reading import Reading
from continuum.dynamics.simulator import Simulator
from continuum.identification.dataset import Split
from continuum.identification.drawn_models import drawn_models
from continuum.identification.free import Free
from continuum.identification.free_run import begun, free_run
from continuum.identification.noise import Noise
from continuum.identification.nrmse import measured_rates, nrmse, position_nrmse, rate_nrmse
from continuum.identification.nrmse_interval import nrmse_interval
from continuum.recordings.recording import Recording

_ITERATIONS = 8
_OPEN = 1.05  # times the noise floor, an error is more than noise
_FAR = 6.0  # times the noise floor; sticking and slipping take most arms that the model describes up to 4, ...
_BEYOND = 2.0  # ... and the others as far as models that are as likely go apart, a few times at most
_DRAWS = 8  # of such models


@dataclass(frozen=True)
class RunScore:
    """One run, predicted by a model that was fitted to others.

    Attributes:
        name: of the run.
        position, rate: Eq. 19; infinite where the model cannot be simulated.
        floor: what sensor noise alone gives Eq. 19 of the position.
        seconds: of processor time that the simulation took.
        seen: what the sensors would read.
        recording: what they did read.
        spread: Eq. 19 of the free runs of models that the fit does not tell from its own, beside its own; 0 of a run
            that is not far from what was measured.
        position_interval, rate_interval: 95 % intervals of both; infinite where they are.
    """

    name: str
    position: float
    rate: float
    floor: float
    seconds: float
    seen: Reading | None
    recording: Recording
    spread: float = 0.0
    position_interval: tuple[float, float] = (np.inf, np.inf)
    rate_interval: tuple[float, float] = (np.inf, np.inf)


def held_out_scores(question: Question, trial: Trial, split: Split, random: np.random.Generator) -> list[RunScore]:
    """Every run predicted by the half without it, in the order of the split.

    Args:
        question: data and model.
        trial: the extension, and where fits of it start.
        split: the halves.
        random: for the spread of predictions that are far off.
    """
    found: list[RunScore] = []
    for half in (split.swapped, split):
        theirs = Question(question.model, question.baseline, half.identification, question.noise)
        fitted = fit_extension(theirs, trial.extension, _without_runs(trial), _ITERATIONS)
        simulator = Simulator(extended(question.model, trial.extension), TOLERANCES).around(fitted.model)
        own = _own_unknowns(trial)
        for recording in half.validation:
            score = _scored(simulator, recording, question.noise, own)
            if score.seen is not None and score.position > _FAR * score.floor:
                models = drawn_models(fitted, random, _DRAWS)
                others = [free_run(simulator.around(model), recording, question.noise, own) for model in models]
                score = replace(score, spread=spread_of(score.seen, others, recording))
            found.append(score)
    return found


def spread_of(seen: Reading, others: Sequence[Reading | None], recording: Recording) -> float:
    """Root mean square of Eq. 19 of what free runs go beside that of the fitted model; the farthest one does not count.

    It is in units of what was measured, as the error is that it is held against.
    """
    theta = recording.theta
    apart = sorted(nrmse(theta + other.theta - seen.theta, theta) for other in others if other is not None)[:-1]
    return float(np.sqrt(np.mean(np.square(apart)))) if apart else 0.0


def is_open(before: Sequence[RunScore]) -> bool:
    """Whether there is a distance to the noise floor that may be closed."""
    return any(b.position > _OPEN * b.floor for b in before)


def is_far(scores: Sequence[RunScore]) -> bool:
    """Whether a run ends up farther from what was measured than the chance of sticking and slipping takes it."""
    return any(score.position > max(_FAR * score.floor, _BEYOND * score.spread) for score in scores)


def is_vague(scores: Sequence[RunScore]) -> bool:
    """Whether a run ends up far from what was measured, as those of models do that are as likely."""
    return any(_FAR * score.floor < score.position <= _BEYOND * score.spread for score in scores)


def closed_gap(before: Sequence[RunScore], after: Sequence[RunScore]) -> float:
    """Part of the distance to the noise floor that is closed, over the runs; 1 is all of it.

    A run weighs as much as it is away, and can take away no more than another one gives.
    """
    pairs = [(b, a) for b, a in zip(before, after, strict=True) if b.position > _OPEN * b.floor]
    weights = [b.position - b.floor if np.isfinite(b.position) else 1.0 for b, _ in pairs]
    parts = [max(_closed(b, a), -1.0) for b, a in pairs]
    return float(np.average(parts, weights=weights)) if pairs else 0.0


def told_gap(before: Sequence[RunScore], after: Sequence[RunScore]) -> float:
    """`closed_gap` as a figure to tell: over runs of which Eq. 19 says something.

    Where a joint hardly moves noise alone makes it 1 or more, and one such stretch would outweigh all the others.
    """
    telling = [(b, a) for b, a in zip(before, after, strict=True) if b.floor < 1.0]
    return closed_gap([b for b, _ in telling], [a for _, a in telling])


def _closed(before: RunScore, after: RunScore) -> float:
    """Of one run; all of it where only the model after can be simulated, nothing where neither can."""
    if np.isinf(before.position):
        return float(np.isfinite(after.position))
    return (before.position - after.position) / (before.position - before.floor)


def _scored(simulator: Simulator, recording: Recording, noise: Noise, own: tuple[Free, ...]) -> RunScore:
    run = begun(simulator, recording, noise, own)
    began = time.process_time()
    seen = None if run is None else run.simulate()
    seconds = time.process_time() - began
    floor = nrmse(recording.theta + noise.angle.white, recording.theta)
    if seen is None:
        return RunScore(recording.name, np.inf, np.inf, floor, seconds, None, recording)
    position, rate = position_nrmse(seen, recording), rate_nrmse(seen, recording)
    return RunScore(
        recording.name, position, rate, floor, seconds, seen, recording,
        position_interval=nrmse_interval(seen.theta, recording.theta),
        rate_interval=nrmse_interval(seen.theta_rate, measured_rates(recording)),
    )  # fmt: skip


def _own_unknowns(trial: Trial) -> tuple[Free, ...]:
    return tuple(dict.fromkeys(Free(u.name, u.joint) for u in trial.unknowns if u.recording is not None))


def _without_runs(trial: Trial) -> Trial:
    """The trial as a start for other runs: windows of other runs begin elsewhere."""
    return replace(trial, own=())

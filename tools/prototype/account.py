"""All figures of the page: Eq. 19 of simulations of the run, every effect alone, the verdict."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.discovery.answer import answer
from continuum.discovery.candidate import Addition
from continuum.discovery.diagnose import Diagnosis
from continuum.discovery.evidence import gain, unexplained
from continuum.discovery.in_words import verdict_in_words
from continuum.discovery.question import Question
from continuum.discovery.round import ITERATIONS
from continuum.discovery.some_runs import carried
from continuum.discovery.trial import Trial, fit_extension
from continuum.discovery.verdict_json import as_mapping
from continuum.discovery.workers import LONG_LOOK, Make, Task, first_look, workers
from continuum.dynamics.effect_lookup import effect_names
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.reading import Reading
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus
from continuum.dynamics.values import with_vector
from continuum.identification.dataset import Dataset
from continuum.identification.fit import THESIS_PARAMETERS, fit
from continuum.identification.free import Free, FreeSpace
from continuum.identification.free_run import free_run
from continuum.identification.noise import Noise, SensorKnowledge, estimate_noise
from continuum.identification.nrmse import measured_rates, nrmse, position_nrmse, rate_nrmse
from continuum.identification.swarm import swarm_identification
from continuum.identification.window_residual import WindowResidual
from continuum.recordings.recording import Recording
from continuum.recordings.recording_csv import read_recording_csv

DATA = Path(__file__).resolve().parents[2] / "data" / "rep7"
OTHER_FLOORS = (0.05, 0.2)  # degrees
_WHOLE = 60  # iterations of a fit to the whole run, whose slopes tell little


@dataclass(frozen=True)
class Simulated:
    """One simulation of the run beside the measurement: Eq. 19 of positions and rates, (n_times, n_joints) [rad]."""

    name: str
    position: float
    rate: float
    theta: Array | None = None


@dataclass(frozen=True)
class Alone:
    """One effect added to the refitted model, where it belongs to joints at those that explain most.

    Attributes:
        effect: its name, and where it acts.
        unknowns: how many it adds.
        gain, deviation: of log-likelihood on stretches that were held out.
        is_significant: whether the gain is more than chance.
        unexplained: share of the windows that noise does not explain with it, 0 to 1.
        position: Eq. 19 of a free run; infinite where it cannot be simulated.
    """

    effect: str
    unknowns: int
    gain: float
    deviation: float
    is_significant: bool
    unexplained: float
    position: float


@dataclass(frozen=True)
class Floor:
    """An answer with another belief of how good an angle is at best.

    Attributes:
        degrees: white noise that is believed at least.
        verdict: of the whole diagnosis.
        effects: that are named, or help.
    """

    degrees: float
    verdict: str
    effects: tuple[str, ...]


@dataclass(frozen=True)
class Account:
    """What the page tells.

    Attributes:
        recording: the run.
        white: standard deviation of the angles' white error as estimated, (n_joints,) [deg].
        floor: Eq. 19 of the position that noise alone gives.
        published: of the author's own simulation, as read off his animation.
        thesis: with the thesis's parameters.
        refitted: with these parameters refitted.
        extended: with the verdict's effects; None where it has none.
        verdict: as `continuum diagnose --json` writes it.
        words: the verdict in words.
        alone: every effect, the largest gain first.
        floors: the answers with other beliefs of how good an angle is at best.
    """

    recording: Recording
    white: Array
    floor: float
    published: Simulated
    thesis: Sequence[Simulated]
    refitted: Sequence[Simulated]
    extended: Simulated | None
    verdict: Mapping[str, Any]
    words: str
    alone: Sequence[Alone]
    floors: Sequence[Floor]


type Tell = Callable[[str, float], None]
"""Told what is going on and the part that is done, 0 to 1."""


def account(tell: Tell, processes: int | None = None, seed: int = 0) -> Account:
    """Work it all out.

    Args:
        tell: told of progress.
        processes: that work at once; as many as there are cores without.
        seed: of intervals and swarm.
    """
    measured, author = (read_recording_csv(DATA / f"rep7_{name}.csv") for name in ("measured", "simulated"))
    model, noise = load_model("lamecc_prototype.yaml"), estimate_noise([measured])
    tell("the thesis's parameters", 0.0)
    published = Simulated(
        "the author's own simulation, as published",
        nrmse(author.theta, measured.theta),
        rate_nrmse(Reading(author.times, author.theta, measured_rates(author), 0.0), measured),
        author.theta,
    )
    thesis = [
        at_rest(model, measured, "its parameters, at rest in the first measured angles"),
        free(model, measured, noise, "its parameters, begun as the first window asks"),
        whole(model, measured, noise, "its parameters, begun as the whole run asks", ()),
    ]
    diagnosis, found = answer(Dataset((measured,)), model, seed, processes, tell)
    tell("refitting to the whole run", 0.0)
    five = tuple(Free(name) for name in THESIS_PARAMETERS)
    refitted = [
        free(found.refitted, measured, noise, "refitted by windows, begun as the first window asks"),
        whole(found.refitted, measured, noise, "refitted to the whole run, from there", five),
        whole(model, measured, noise, "refitted to the whole run, from the thesis's parameters", five),
        swarmed(model, measured, noise, np.random.default_rng(seed)),
    ]
    extended = None
    if found.verdict.extension:
        extended = free(
            found.model,
            measured,
            noise,
            "extended, begun as the first window asks; offsets and drifts, as the run asks",
            _own(found.verdict.best),
        )
    return Account(
        measured,
        np.degrees(noise.angle.white),
        float(np.mean(noise.angle.white / np.std(measured.theta, axis=0))),
        published,
        thesis,
        refitted,
        extended,
        as_mapping(found),
        verdict_in_words(found.verdict),
        every_effect_alone(diagnosis, measured, tell, processes),
        with_other_floors(measured, model, seed, processes, tell),
    )


def at_rest(model: Model, recording: Recording, name: str) -> Simulated:
    """A free run as the thesis began its own."""
    run = Simulator(model).run(recording.theta[0], recording.times, recording.pull)
    complete = run.status is SimulationStatus.COMPLETE
    seen = Reading(run.times, run.theta, run.theta_rate, float(run.times[0])) if complete else None
    return compared(seen, recording, name)


def free(model: Model, recording: Recording, noise: Noise, name: str, own: tuple[Free, ...] = ()) -> Simulated:
    """A free run from the state that explains the first window best."""
    return compared(free_run(Simulator(model), recording, noise, own), recording, name)


def whole(model: Model, recording: Recording, noise: Noise, name: str, unknowns: Sequence[Free]) -> Simulated:
    """A free run whose first state, and unknowns if any, explain the whole run as well as a descent finds."""
    simulator = Simulator(model)
    fitted = fit(simulator, [recording], noise, unknowns, length=None, iterations=_WHOLE)
    if not fitted.parts:
        return compared(None, recording, name)
    run = WindowResidual(simulator, recording, 0, noise, fitted.space, None)
    return compared(run.simulate(fitted.coordinates, fitted.unknowns.own), recording, name)


def swarmed(model: Model, recording: Recording, noise: Noise, random: np.random.Generator) -> Simulated:
    """The thesis's own way of refitting: a swarm, from rest, that lowers the error of the rates."""
    simulator = Simulator(model)
    space = FreeSpace(model, [Free(name) for name in THESIS_PARAMETERS])
    found = swarm_identification(simulator, [recording], space, random)
    better = with_vector(model, space.common_values(found.coordinates))
    return free(better, recording, noise, "refitted as the thesis did, by a swarm, begun as the first window asks")


def compared(seen: Reading | None, recording: Recording, name: str) -> Simulated:
    """Eq. 19; infinite where there was no simulation."""
    if seen is None:
        return Simulated(name, np.inf, np.inf)
    return Simulated(name, position_nrmse(seen, recording), rate_nrmse(seen, recording), seen.theta)


def every_effect_alone(
    diagnosis: Diagnosis, recording: Recording, tell: Tell, processes: int | None = None
) -> list[Alone]:
    """Each one on top of the refitted model, whatever the search made of it; those that pull alone are left out."""
    question, before = diagnosis.question, diagnosis.verdict.baseline
    names = [look.extension[-1].effect for look in diagnosis.rounds[0].looks] if diagnosis.rounds else effect_names()
    found = []
    with workers(question, processes or os.cpu_count() or 1) as make:
        for number, name in enumerate(names):
            tell(f"alone: {name}", number / len(names))
            found.append(_alone(question, _best_fit(make, name, before), before, recording))
    return sorted(found, key=lambda one: -one.gain)


def _best_fit(make: Make, name: str, before: Trial) -> Trial:
    """One effect at its best joints, begun from the refitted model, from windows as measured and from a close look."""
    extension = (Addition(name),)
    (look,) = make([first_look(extension, before, LONG_LOOK, closely=True)])
    starts = [Task(extension, near, ITERATIONS, find_joints=True) for near in (before, carried(look, before))]
    starts.append(Task(extension, before, ITERATIONS, find_joints=True, afresh=True))
    return max(make(starts), key=lambda trial: gain(trial, before).log_likelihood)


def _alone(question: Question, trial: Trial, before: Trial, recording: Recording) -> Alone:
    model = fit_extension(question, trial.extension, trial, 1).model
    seen = free_run(Simulator(model), recording, question.noise, _own(trial))
    position = np.inf if seen is None else position_nrmse(seen, recording)
    won, unknowns = gain(trial, before), len(trial.unknowns) - len(before.unknowns)
    return Alone(
        str(trial.extension[-1]), unknowns, won.log_likelihood, won.deviation, won.is_significant, unexplained(trial),
        position,
    )  # fmt: skip


def with_other_floors(measured: Recording, model: Model, seed: int, processes: int | None, tell: Tell) -> list[Floor]:
    """What would be answered were angles believed to be better, or no better than worse."""
    found = []
    for degrees in OTHER_FLOORS:
        known = SensorKnowledge(angle_floor=float(np.deg2rad(degrees)))
        _, other = answer(Dataset((measured,)), model, seed, processes, tell, known=known)
        helps = [str(cause.addition) for cause in other.verdict.causes]
        found.append(Floor(degrees, other.verdict.kind.value, tuple(helps)))
    return found


def _own(trial: Trial) -> tuple[Free, ...]:
    """Unknowns that the run has for itself."""
    return tuple(dict.fromkeys(Free(u.name, u.joint) for u in trial.unknowns if u.recording is not None))

"""All figures of the page: the diagnosis, its repetitions, the prediction of the end of the run, every effect alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from continuum.arrays import Array
from continuum.discovery import Diagnosis, diagnose
from continuum.discovery.baseline import run_of
from continuum.discovery.candidates import examine
from continuum.discovery.examination import Examination, Examined
from continuum.discovery.open_loop import RunSimulation, Simulators
from continuum.discovery.problem import Problem, State, point_of
from continuum.discovery.score_test import promises
from continuum.discovery.search import with_library
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.estimation.run import Trajectory
from continuum.identification.local_derivatives import local_derivative
from continuum.identification.nrmse import nrmse_by_joint
from continuum.recordings.recording import Recording
from continuum.recordings.recording_csv import read_recording_csv
from tools.benchmarks.prototype.stability import NOISE, ROUNDING, Said, repeated, said

DATA = Path(__file__).resolve().parents[3] / "data" / "rep7"
FITTED = 0.6  # of the rows, from which the rest is predicted
THE_GUESS = "inertia"


@dataclass(frozen=True)
class Predicted:
    """A simulation of unseen rows: terms of Eq. 19 by joint, and errors by joint [deg], (n,) each."""

    model: str
    begins: str
    by_joint: Array
    degrees: Array


@dataclass(frozen=True)
class Account:
    """What the page tells.

    Attributes:
        diagnosis: of the whole run.
        thesis: simulation by the thesis's parameters from rest, (n_times, n) [rad].
        rounding, noise: the same diagnosis again, itself the first of both; what was changed, and what was said.
        of_beginning: diagnosis of the beginning.
        predicted: simulations of the end by its models.
        sd: standard deviation of the end's measured angles, (n,) [deg].
        alone: every effect, and by how much it is expected to lower the logarithm of the refitted model's error.
        with_guess: where the guess gains most in addition to the verdict, empty where it is part of that; the gain.
    """

    diagnosis: Diagnosis
    thesis: Array
    rounding: Sequence[tuple[str, Said]]
    noise: Sequence[tuple[str, Said]]
    of_beginning: Diagnosis
    predicted: Sequence[Predicted]
    sd: Array
    alone: Sequence[tuple[str, float]]
    with_guess: tuple[str, float]


def account(tell: Callable[[str, float], None]) -> Account:
    """Compute all figures."""
    path, model = DATA / "rep7_measured.csv", load_model("lamecc_prototype.yaml")
    run = read_recording_csv(path)
    result = diagnose([run], model, progress=tell)
    again = [("nothing", said(result))]
    for change in (*ROUNDING, *NOISE):
        tell("the same again", len(again) / (len(ROUNDING) + len(NOISE) + 1))
        again.append((_in_words(*change), repeated(path, *change)))
    tell("the end of the run", 1.0)
    cut, found = int(FITTED * run.times.size), examine([run], model)
    of_beginning, predicted = end_predicted(run, cut, model)
    return Account(
        result, Simulator(model).run(run.theta[0], run.times).theta,
        again[: 1 + len(ROUNDING)], [again[0], *again[1 + len(ROUNDING) :]],
        of_beginning, predicted, np.degrees(np.std(run.theta[cut:], axis=0)),
        every_effect_alone(found), guess_with(found, ended_with(found, result)),
    )  # fmt: skip


def end_predicted(run: Recording, cut: int, model: Model) -> tuple[Diagnosis, list[Predicted]]:
    """Diagnose the rows before ``cut``, and simulate the rest by both models, from two estimates of its first state."""
    first, out = replace(run.rows(slice(0, cut)), name=f"{run.name}, beginning"), []
    result, found = diagnose([first], model, with_power=False), examine([first], model)
    for name, one in (("refitted", found.baseline), ("extended", ended_with(found, result))):
        problem, state, way = found.problem, one.fit.state, one.fit.state.ways[0]
        read = problem.structure.readings(problem.runs[0], way.q, way.w, point_of(problem, state).by_run[0])
        shift = read[-1, : run.n_joints] - way.q[-1]  # what the sensors add, as the beginning tells it
        rate = local_derivative(run.times[cut:], run.theta[cut:], 0, degree=3)
        for begins, row, q, w in (
            ("smoothed", cut - 1, way.q[-1], way.w[-1]),
            ("measured", cut, run.theta[cut] - shift, rate),
        ):
            angles = simulated_from(problem, state, run.rows(slice(row, None)), q, w)[cut - row :]
            error = np.degrees(np.sqrt(np.mean((angles - run.theta[cut:]) ** 2, axis=0)))
            out.append(Predicted(name, begins, nrmse_by_joint(angles, run.theta[cut:]), error))
    return result, out


def simulated_from(problem: Problem, state: State, part: Recording, q: Array, w: Array) -> Array:
    """Simulate other rows with a state's values from angles and rates (n,); return the readings, (n_times, n) [rad]."""
    run, rows = run_of(part, problem.structure.given).with_held(problem.runs[0].held), np.ones((part.times.size, 1))
    way = Trajectory(rows * q, rows * w, 0 * rows * q, 0 * rows * q)
    there = Simulators(replace(problem, runs=(run,)), (part,))
    simulation = RunSimulation(there, replace(state, ways=(way,)), 0)
    return simulation.readings(slice(0, part.times.size), np.zeros(3 * part.n_joints))


def every_effect_alone(found: Examination) -> list[tuple[str, float]]:
    """Return each linear effect at the joints where it predicts most, the most promising first."""
    base, best = found.baseline, dict[str, tuple[str, float]]()
    for one in promises(found.judge, base.fit, base.found.lin.library):
        best.setdefault(one.hypothesis.effect, (one.hypothesis.label, one.gain))
    return list(best.values())


def guess_with(found: Examination, best: Examined) -> tuple[str, float]:
    """Where the thesis's guess promises most beside a set, and by how much it lowers the logarithm of the error."""
    if THE_GUESS in {h.effect for h in best.found.chosen}:
        return "", 0.0
    library = with_library(found.problem, best.found).lin.library
    ranked = promises(found.judge, best.fit, library)
    return next((one.hypothesis.label, one.gain) for one in ranked if one.hypothesis.effect == THE_GUESS)


def ended_with(found: Examination, result: Diagnosis) -> Examined:
    """Return the candidate with which a diagnosis ended."""
    key = {(cause.effect, cause.joints) for cause in result.causes}
    return next(one for one in (found.baseline, *found.others) if set(one.candidate.effects) == key)


def _in_words(kernel: str, relative: float, degrees: float, seed: int) -> str:
    noise = f"{relative:g} of each angle" if relative else f"{degrees:g} degrees"
    return "kernel" if kernel else f"{noise}, draw {seed}"

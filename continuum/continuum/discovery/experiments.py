"""The next experiment: the run that separates the possible causes, or shows what these recordings cannot.

Each of two sets of effects, with its values fitted to the recordings, simulates a run that was not made. One set is
refitted to the other's angles within the uncertainty of its values. The remaining residuals are the information of the
run (Box and Hill, Technometrics 9, 1967, 57-71), minus those that the other set itself would leave if its values were
slightly off, as where joints come to rest. They give the number of runs that the decision needs.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from continuum.arrays import Array
from continuum.discovery.baseline import run_of
from continuum.discovery.decision import ALIKE, CHANCE, is_farther_by
from continuum.discovery.designs import Design, designs
from continuum.discovery.examination import Examination, Examined
from continuum.discovery.fit_result import Fitted
from continuum.discovery.hypotheses import PRIOR
from continuum.discovery.library import Library
from continuum.discovery.normal_equations import NormalEquations, Scale, Values
from continuum.discovery.output_error import DAMPING, ENOUGH, OutputError
from continuum.discovery.power import POWER, powers
from continuum.discovery.problem import Problem, ValueKey
from continuum.discovery.result import Detectable, Experiment
from continuum.discovery.zeros_by_hand import is_zero, probability, zeros_in
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus
from continuum.estimation.run import Run, Trajectory
from continuum.recordings.recording import Recording

_MOST_RUNS = 6  # most repetitions that a laboratory makes
_REFITS = 8  # of a set to a run; the weights of residuals rise from one to the next as they become less correlated


def experiments(
    found: Examination,
    compared: Sequence[Examined],
    library: Library,
    recordings: Sequence[Recording],
    power: Sequence[Detectable],
) -> tuple[Experiment, ...]:
    """Return informative further runs, the best first.

    Args:
        found: result of the search.
        compared: the two sets to distinguish, from `rivals`; or one.
        library: hypotheses about the first set.
        recordings: runs that were made.
        power: what these would have shown.
    """
    hidden, out = {one.label for one in power if not one.is_shown}, list[Experiment]()
    gained = float(np.log(found.baseline.fit.error / compared[0].fit.error))
    for design in designs(found.problem.structure.given, recordings):
        runs = [_simulated(found, one.fit, design) for one in compared]
        made = [run for run in runs if run is not None]
        if len(made) < len(compared):
            continue
        by_chance = [
            _Trial(found.judge, one.fit, run, design, drawn=True).refitted().excess
            for one, run in zip(compared, made, strict=True)
        ]
        refits = [
            (_Trial(found.judge, one.fit, run, design).refitted(), by_chance[k])
            for i, one in enumerate(compared) for k, run in enumerate(made) if i != k
        ]  # fmt: skip
        apart = [one.excess - chance for one, chance in refits]
        needed = [
            1 if refit.contradicts else _runs_needed(one, len(recordings), ALIKE * gained)
            for one, (refit, _) in zip(apart, refits, strict=True)
        ]
        itself = _Trial(found.judge, compared[0].fit, made[0], design)
        shows = tuple(sorted(itself.shown(library, hidden)))
        separates = min((float(np.mean(one)) for one in apart), default=np.nan)
        out.append(
            Experiment(design.name, design.instruction, separates, max(needed) if all(needed) and needed else 0, shows)
        )
    return tuple(sorted(out, key=lambda one: (one.runs or np.inf, -np.nan_to_num(one.separates), -len(one.shows))))


def rivals(sets: Sequence[Examined]) -> Sequence[Examined]:
    """Return the likeliest set and the likeliest with other effects: which effect matters more than where it acts."""
    other = rival_of([{h.effect for h in one.found.chosen} for one in sets])
    return sets if other is None else [sets[0], sets[other]]


def rival_of(effects: Sequence[Collection[str]]) -> int | None:
    """Return the number of the set to compare with the first, given the effects of each; None if there is only one."""
    return next((k for k, names in enumerate(effects) if names != effects[0]), 1 if len(effects) > 1 else None)


def _runs_needed(excess: Array, recordings: int, alike: float) -> int:
    """Return the number of runs after which the decision excludes a set, given its excess log error; 0 for none.

    It is the same t test, on as many segments as a diagnosis simulates, distributed over all recordings; in those that
    were made, the sets err alike.
    """
    for count in range(1, _MOST_RUNS + 1):
        new = round(ENOUGH * count / (recordings + count))
        after = np.concatenate([np.zeros(ENOUGH - new), np.resize(excess, new)])
        if is_farther_by(after, alike):
            return count
    return 0


@dataclass(frozen=True)
class _Run:
    """A run that was not made.

    Attributes:
        run: rows with simulated readings, without noise.
        way: the simulated motion.
        recording: recording with the inputs.
    """

    run: Run
    way: Trajectory
    recording: Recording


def _simulated(found: Examination, fit: Fitted, design: Design) -> _Run | None:
    """Return the run as a set simulates it; None if the simulation fails."""
    problem, s = found.problem, found.problem.structure
    still = np.tile(design.posture, (design.times.size, 1))
    recording = Recording(
        design.name, design.times, still, None, design.inputs if isinstance(design.inputs, Tensions) else None, (),
        design.inputs if isinstance(design.inputs, JointTorques) else None,
    )  # fmt: skip
    run, way = run_of(recording, s.given, with_rates=False), Trajectory(still, 0 * still, 0 * still, 0 * still)
    per_run = {key: (-1.0) ** k * one.sd / PRIOR for k, one in enumerate(fit.unknowns.per_run[0]) for key in one.places
           if not _is_zeroed(problem, key, design)}  # fmt: skip
    shared = {key: value for key, value in fit.state.shared.items() if not _is_zeroed(problem, key, design)}
    state = replace(fit.state, shared=shared, per_run=(per_run,), ways=(way,))
    judge = found.judge.along(replace(problem, runs=(run,)), (recording,))
    motion, readings = judge.motion(state, 0)
    if motion.status is not SimulationStatus.COMPLETE:
        return None
    none = np.zeros_like(motion.theta)
    return _Run(replace(run, readings=readings), Trajectory(motion.theta, motion.theta_rate, none, none), recording)


class _Refit(NamedTuple):
    """The result of a refit.

    Attributes:
        excess: log error of each segment above that of the noise, (segments,).
        contradicts: whether it contradicts zeros that were set by hand.
    """

    excess: Array
    contradicts: bool


class _Trial:
    """A set refitted to a run that another set simulates.

    Args:
        judge: output-error fits of the recordings.
        fit: fit of the set to the recordings.
        made: the simulated run.
        design: design of the run.
        drawn: whether the set's values are drawn from their posterior, which gives the initial error of the set that
            simulated the run.
    """

    def __init__(self, judge: OutputError, fit: Fitted, made: _Run, design: Design, drawn: bool = False) -> None:
        problem = judge.problem
        self._design = design
        self._judge = judge.along(replace(problem, runs=(made.run,)), (made.recording,))
        measured = np.array(
            [any(_is_zeroed(problem, key, design) for key in one.places) for one in fit.unknowns.common]
        )
        values = np.where(measured, 0.0, fit.values.common)
        sds = np.where(measured, [one.sd for one in fit.unknowns.common], fit.sd)
        if drawn:
            values = values + sds * np.random.default_rng(0).standard_normal(len(values)) * ~measured
            low, high = (np.array([getattr(one, end) for one in fit.unknowns.common]) for end in ("lower", "upper"))
            values = np.clip(values, low, high)
        known = zip(fit.unknowns.common, values, sds, strict=True)
        common = [replace(one, mean=float(value), sd=float(sd)) for one, value, sd in known]
        per_run = [replace(one, mean=0.0, start=0.0) for one in fit.unknowns.per_run[0]]
        state = replace(fit.state, per_run=({},), ways=(made.way,))
        none = np.zeros(len(self._judge.local_precision))
        start = Values(values, (np.zeros(len(per_run)),), (none,) * self._judge.segments)
        total = made.run.readings.size
        independent = fit.observations / sum(run.readings[:, : run.n].size for run in judge.problem.runs)
        self._fit = replace(
            fit, state=state, unknowns=fit.unknowns.about(state, common, [per_run]), values=start,
            errors=np.full(self._judge.segments, self._judge.floor), observations=min(1.0, independent) * total,
        )  # fmt: skip

    def refitted(self) -> _Refit:
        """Return what is left after some steps of the set towards the run, with noise."""
        fit, judge = self._fit, self._judge
        segments = judge.simulated(fit.unknowns, fit.values)
        if not all(np.isfinite(one.square) for one in segments):
            return _Refit(np.full(len(segments), np.inf), False)
        random, noisy = np.random.default_rng(0), segments
        for _ in range(_REFITS):
            noise = [random.normal(0.0, judge.floor, one.readings.size) for one in noisy]
            scale = [one.with_residuals(one.residuals + e) for one, e in zip(noisy, noise, strict=True)]
            weights = Scale(scale, judge.floor).weights([one.error for one in scale])
            normal = NormalEquations(fit.unknowns, fit.values, segments, weights, judge.local_precision)
            there = normal.stepped(DAMPING)
            left = normal.expected_residuals(there)
            noisy = [one.with_residuals(r.ravel()) for one, r in zip(segments, left, strict=True)]
        excess = 0.5 * np.log1p(np.array([np.mean(r**2) for r in left]) / judge.floor**2)
        if not self._design.zeroed:
            return _Refit(excess, False)
        refitted = replace(fit, values=there, sd=np.sqrt(np.diag(normal.covariance)), per_run_sd=normal.per_run_sd())
        return _Refit(excess, probability(zeros_in(refitted, 0)) < CHANCE)

    def shown(self, library: Library, hidden: set[str]) -> set[str]:
        """Return labels of the ``hidden`` effects with linear sizes that the run would show at their typical sizes."""
        found = powers(self._judge, self._fit, library, linear_only=True, only=hidden)
        return {one.hypothesis.label for one in found if one.probability(1.0) >= POWER}


def _is_zeroed(problem: Problem, key: ValueKey, design: Design) -> bool:
    """Whether a value is the zero of a sensor in a design in which these are set by hand."""
    effect, name, _ = key
    sensors = {one.name: one.parameters for one in problem.structure.sensors}
    return design.zeroed and effect in sensors and is_zero(sensors[effect][name])

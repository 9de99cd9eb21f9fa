"""From recordings to candidates: baseline, search, confirmation, once through."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from continuum.discovery.baseline import fitted_baseline, has_tension, problem_of
from continuum.discovery.candidate import Candidate, Key
from continuum.discovery.confirmation import Confirmation, OpenLoop
from continuum.discovery.gauss_newton import moved
from continuum.discovery.hypotheses import UNKNOWN
from continuum.discovery.problem import Problem, State, linearise
from continuum.discovery.search import Found, Progress, find, matching, posterior_of_levels
from continuum.dynamics.dry_friction import with_dry_friction
from continuum.dynamics.model import Model
from continuum.estimation.structure import Structure
from continuum.recordings.recording import Recording

SIMULABLE_STEPS = 2
"""Gauss-Newton steps after which a refit without some nuisances has settled."""


def silent(_what: str, _share: float) -> None:
    """Tell nobody of progress."""


@dataclass(frozen=True)
class Examined:
    """A candidate with where the search left it.

    Attributes:
        candidate: for the decision.
        found: state, library and evidence about it.
        simulable: the state refitted for simulation.
        open_loop: its simulations.
    """

    candidate: Candidate
    found: Found
    simulable: State
    open_loop: OpenLoop


@dataclass(frozen=True)
class Examination:
    """All that a decision rests on.

    Attributes:
        problem: fixed before the search.
        baseline: the refitted model alone.
        others: sets of effects, the most probable first.
        log: of the search, for developers.
    """

    problem: Problem
    baseline: Examined
    others: tuple[Examined, ...]
    log: tuple[str, ...]


def examine(
    recordings: Sequence[Recording],
    model: Model,
    effects: Sequence[str] | None = None,
    progress: Progress = silent,
) -> Examination:
    """Search for sets of effects and simulate each open loop."""
    progress("compiling", 0.0)
    dry = with_dry_friction(model)
    structure = Structure(dry, effects, has_tension(recordings, dry))
    problem = problem_of(structure, recordings)
    progress("baseline", 0.1)
    problem, start = fitted_baseline(problem)
    found = find(problem, start, progress)
    progress("simulating open loop", 0.85)
    confirmation = Confirmation(problem, tuple(recordings))
    base = _examined(problem, confirmation, found.baseline, start)
    others: dict[frozenset[object], Examined] = {}
    for stage in found.stages:
        one = _examined(problem, confirmation, stage, stage.lin.state)
        key = frozenset(one.candidate.effects)
        if key not in others or one.candidate.log_evidence > others[key].candidate.log_evidence:
            others[key] = one
    ranked = sorted(others.values(), key=lambda one: -one.candidate.log_evidence)
    return Examination(problem, base, tuple(ranked), tuple(found.log))


def _examined(problem: Problem, confirmation: Confirmation, found: Found, state: State) -> Examined:
    evidence, chosen = found.lin.evidence, found.chosen
    levels = np.asarray(problem.levels)[list(found.lin.levels)] * float(np.mean(problem.noise.sigma))
    sigma = float(np.sqrt(posterior_of_levels(evidence, chosen) @ levels**2))
    simulable = _simulable(problem, state, found)
    simulated = confirmation.simulate(simulable)
    key: Key = tuple(h.key for h in chosen)
    candidate = Candidate(key, evidence.total(chosen, with_constraints=True), sigma, simulated.errors)
    return Examined(candidate, found, simulable, simulated)


def _simulable(problem: Problem, state: State, found: Found) -> State:
    """The state refitted without the nuisances that the simulator's equations do not have."""
    level = found.lin.levels[found.lin.evidence.best_level(found.chosen)]
    keys = [h.key for h in found.chosen]
    for _ in range(SIMULABLE_STEPS):
        lin = linearise(problem, state, [level], {h.effect for h in found.chosen}, simulable=True)
        state = moved(lin, matching(lin, keys), 0, level)
    return state


def free_form_gain(problem: Problem, found: Found) -> float:
    """By how much a torque of any form, at one joint or at all, raises a set's log-evidence."""
    lin = linearise(problem, found.lin.state, None, {h.effect for h in found.chosen}, free_form=True)
    keys = [h.key for h in found.chosen]
    chosen = tuple(next(h for h in lin.library.hypotheses if h.key == key) for key in keys)
    alone = lin.evidence.total(chosen, with_constraints=True)
    forms = [h for h in lin.library.hypotheses if h.effect == UNKNOWN]
    return max(lin.evidence.total((*chosen, form), with_constraints=True) for form in forms) - alone

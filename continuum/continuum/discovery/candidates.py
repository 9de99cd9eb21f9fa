"""From recordings to candidates: baseline, search, confirmation, once through."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from continuum.discovery.baseline import fitted_baseline, has_tension, problem_of
from continuum.discovery.candidate import Candidate
from continuum.discovery.output_error import Fitted, OutputError
from continuum.discovery.problem import Problem
from continuum.discovery.search import Found, Progress, find
from continuum.dynamics.dry_friction import with_dry_friction
from continuum.dynamics.model import Model
from continuum.estimation.structure import Structure
from continuum.recordings.recording import Recording

MOST_FITTED = 5
"""Sets that are fitted by open-loop simulations at most, the most probable first."""


def silent(_what: str, _share: float) -> None:
    """Tell nobody of progress."""


@dataclass(frozen=True)
class Examined:
    """A candidate with where the search left it.

    Attributes:
        found: state, library and evidence about it.
        fit: by open-loop simulations.
    """

    found: Found
    fit: Fitted

    @property
    def candidate(self) -> Candidate:
        """For the decision."""
        return Candidate(tuple(h.key for h in self.found.chosen), self.fit.errors)


@dataclass(frozen=True)
class Examination:
    """All that a decision rests on.

    Attributes:
        problem: fixed before the search.
        judge: what fits were made by.
        baseline: the refitted model alone.
        others: sets of effects, the most probable first.
        log: of the search, for developers.
    """

    problem: Problem
    judge: OutputError
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
    progress("simulating open loop", 0.6)
    judge = OutputError(problem, tuple(recordings))
    ranked = _best_of_each(found.stages)[:MOST_FITTED] or [found.baseline]
    fits = [judge.fit(ranked[0])]
    for number, stage in enumerate(ranked[1:]):
        progress("simulating open loop", 0.7 + 0.05 * number)
        fits.append(judge.fit(stage, fits[0]))
    best = fits[int(np.argmin([fit.error for fit in fits]))]
    parts = [_is_part(stage, ranked[fits.index(best)]) for stage in ranked]
    fits = [
        judge.better(fit, stage, best) if part else fit for fit, stage, part in zip(fits, ranked, parts, strict=True)
    ]
    base = fits[0] if ranked[0] is found.baseline else judge.fit(found.baseline, best)
    others = [Examined(stage, fit) for stage, fit in zip(ranked, fits, strict=True) if stage.chosen]
    return Examination(problem, judge, Examined(found.baseline, base), tuple(others), tuple(found.log))


def _is_part(one: Found, whole: Found) -> bool:
    return {h.key for h in one.chosen} < {h.key for h in whole.chosen}


def _best_of_each(stages: Sequence[Found]) -> list[Found]:
    """The most probable state of each set of effects, the most probable set first."""
    best: dict[frozenset[object], tuple[float, Found]] = {}
    for one in stages:
        key, evidence = frozenset(h.key for h in one.chosen), _log_evidence(one)
        if key not in best or evidence > best[key][0]:
            best[key] = evidence, one
    return [one for _, one in sorted(best.values(), key=lambda pair: -pair[0])]


def _log_evidence(found: Found) -> float:
    return found.lin.evidence.total(found.chosen, with_constraints=True)

"""From recordings to candidates: baseline, screening, fits, once through."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from continuum.discovery.baseline import fitted_baseline, has_tension, problem_of
from continuum.discovery.candidate import Candidate
from continuum.discovery.decision import ALIKE
from continuum.discovery.output_error import Fitted, OutputError
from continuum.discovery.problem import Problem
from continuum.discovery.search import Found, Progress, screen, with_second
from continuum.dynamics.dry_friction import with_dry_friction
from continuum.dynamics.model import Model
from continuum.estimation.structure import Structure
from continuum.recordings.recording import Recording


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
        n_joints = self.found.lin.problem.structure.n
        return Candidate(tuple(h.key for h in self.found.chosen), self.fit.errors, n_joints)


@dataclass(frozen=True)
class Examination:
    """All that a decision rests on.

    Attributes:
        problem: fixed before the search.
        judge: what fits were made by.
        baseline: the refitted model alone.
        others: sets of effects.
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
    screened = screen(problem, start, progress)
    fits = _Fits(OutputError(problem, tuple(recordings)))
    for number, one in enumerate(screened.singles):
        progress("simulating open loop", 0.6 + 0.05 * number)
        fits.add(one)
    fits.go_on()
    if (best := fits.unexplained) is not None:
        progress("a second effect", 0.8)
        for one in _distinct(with_second(problem, best.found, screened)):
            fits.add(one)
    base = Examined(screened.baseline, fits.of_baseline(screened.baseline))
    return Examination(problem, fits.judge, base, tuple(fits.examined), screened.log)


class _Fits:
    """Fits of sets, each beginning where the nearest so far ended."""

    def __init__(self, judge: OutputError) -> None:
        self.judge = judge
        self.examined: list[Examined] = []

    @property
    def _best(self) -> Examined | None:
        return min(self.examined, key=lambda one: one.fit.error, default=None)

    @property
    def unexplained(self) -> Examined | None:
        """The nearest set, where its simulations err by more than the sensors."""
        best = self._best
        return best if best and best.fit.error > (1 + ALIKE) * self.judge.floor else None

    def go_on(self) -> None:
        """Go on with the nearest set's fit where it errs by more than the sensors."""
        if (best := self.unexplained) is not None:
            fit = min(best.fit, self.judge.further(best.found, best.fit), key=lambda one: one.error)
            self.examined[self.examined.index(best)] = Examined(best.found, fit)

    def of_baseline(self, found: Found) -> Fitted:
        """Its fit, by multi-start and from where the nearest set's ended: what a bad optimum leaves is no effect's."""
        best = self._best
        return self.judge.fit(found, best.fit if best else None, multi_start=True)

    def add(self, found: Found) -> None:
        """Fit a set; where it is the nearest, its parts are fitted again from there: they are nested in it."""
        best = self._best
        fit = self.judge.fit(found, best.fit if best else None)
        self.examined.append(Examined(found, fit))
        if fit.error > min(one.fit.error for one in self.examined):
            return
        for number, one in enumerate(self.examined):
            if _is_part(one.found, found):
                nested = min(one.fit, self.judge.fit(one.found, fit), key=lambda each: each.error)
                self.examined[number] = Examined(one.found, nested)


def _is_part(one: Found, whole: Found) -> bool:
    return {h.key for h in one.chosen} < {h.key for h in whole.chosen}


def _distinct(sets: Sequence[Found]) -> list[Found]:
    """The most probable state of each set of effects."""
    best: dict[frozenset[object], Found] = {}
    for one in sorted(sets, key=lambda one: one.log_evidence):
        best[frozenset(h.key for h in one.chosen)] = one
    return list(best.values())

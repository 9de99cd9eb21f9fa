"""From recordings to candidates: baseline, screening, fits, once through."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from continuum.discovery.baseline import fitted_baseline, has_tension, problem_of
from continuum.discovery.candidate import Candidate
from continuum.discovery.decision import ALIKE
from continuum.discovery.output_error import Fitted, OutputError
from continuum.discovery.problem import Problem
from continuum.discovery.search import MOST, Found, Progress, alternatives, screen, with_second, with_unseen
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
        if (best := fits.unexplained) is not None and len(best.found.chosen) < MOST:
            for one in with_unseen(problem, best.found):
                fits.add(one)
        if (best := fits.nearest) is not None and len(best.found.chosen) > 1:
            for one in alternatives(problem, best.found):
                fits.add(one)
    base = Examined(screened.baseline, fits.of_baseline(screened.baseline))
    return Examination(problem, fits.judge, base, tuple(fits.examined), screened.log)


class _Fits:
    """Fits of sets, each beginning where the nearest so far ended."""

    def __init__(self, judge: OutputError) -> None:
        self.judge = judge
        self.examined: list[Examined] = []

    @property
    def nearest(self) -> Examined | None:
        """The set whose simulations err least."""
        return min(self.examined, key=lambda one: one.fit.error, default=None)

    @property
    def unexplained(self) -> Examined | None:
        """The nearest set, where its simulations err by more than the sensors."""
        best = self.nearest
        return best if best and best.fit.error > (1 + ALIKE) * self.judge.floor else None

    def go_on(self) -> None:
        """Go on with the nearest set's fit where it errs by more than the sensors."""
        if (best := self.unexplained) is not None:
            self._replace(Examined(best.found, self.judge.further(best.found, best.fit)))

    def of_baseline(self, found: Found) -> Fitted:
        """Its fit, by multi-start and from where the nearest set's ended: what a bad optimum leaves is no effect's."""
        best = self.nearest
        return self.judge.fit(found, best.fit if best else None, multi_start=True)

    def add(self, found: Found) -> None:
        """Fit a set; where it is the nearest, fit its parts from there: they are nested in it."""
        best = self.nearest
        fit = self.judge.fit(found, best.fit if best else None)
        self.examined.append(Examined(found, fit))
        if fit.error > min(one.fit.error for one in self.examined):
            return
        for part in (found.with_only(h) for h in found.chosen if len(found.chosen) > 1):
            self._replace(Examined(part, self.judge.fit(part, fit)))

    def _replace(self, new: Examined) -> None:
        """Keep the nearer fit of a set."""
        for number, old in enumerate(self.examined):
            if old.found.key == new.found.key:
                self.examined[number] = min(old, new, key=lambda one: one.fit.error)
                return
        self.examined.append(new)


def _distinct(sets: Sequence[Found]) -> list[Found]:
    """The most probable state of each set of effects."""
    best: dict[frozenset[object], Found] = {}
    for one in sorted(sets, key=lambda one: one.log_evidence):
        best[one.key] = one
    return list(best.values())

"""From recordings to candidates: baseline, screening, fits, once through."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log

from continuum.discovery.baseline import fitted_baseline, has_tension, problem_of
from continuum.discovery.candidate import Candidate
from continuum.discovery.decision import ALIKE, is_farther
from continuum.discovery.output_error import Fitted, OutputError
from continuum.discovery.problem import Problem
from continuum.discovery.score_test import expected_gains
from continuum.discovery.search import (
    MOST,
    PROMISING,
    RUNNER_UP,
    Found,
    Progress,
    alternatives,
    compatible,
    screen,
    with_library,
    with_second,
    with_unseen,
)  # fmt: skip
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
    for number, one in enumerate((screened.baseline, *screened.singles)):
        progress("simulating open loop", 0.6 + 0.03 * number)
        fits.add(one)
    for one in fits.promising(screened.baseline):
        fits.add(one)
    fits.go_on()
    if (best := fits.unexplained) is not None and best.found.chosen:
        progress("a second effect", 0.8)
        for one in fits.promising(with_library(problem, best.found)):
            fits.add(one)
        for one in _distinct(with_second(problem, best.found, screened)):
            fits.add(one)
    if (best := fits.unexplained) is not None and len(best.found.chosen) < MOST:
        for one in with_unseen(problem, best.found):
            fits.add(one)
    if (best := fits.nearest).found.chosen and (len(best.found.chosen) > 1 or fits.unexplained):
        for one in alternatives(problem, best.found):
            fits.add(one)
    fits.settle()
    base, *others = fits.examined
    return Examination(problem, fits.judge, base, tuple(others), screened.log)


class _Fits:
    """Fits of sets, the baseline first, each beginning where the nearest so far ended."""

    def __init__(self, judge: OutputError) -> None:
        self.judge = judge
        self._by_key: dict[frozenset[object], Examined] = {}

    @property
    def examined(self) -> list[Examined]:
        """All sets."""
        return list(self._by_key.values())

    @property
    def nearest(self) -> Examined:
        """The set whose simulations err least."""
        return min(self.examined, key=_error)

    @property
    def unexplained(self) -> Examined | None:
        """The nearest set, where its simulations err by more than the sensors."""
        best = self.nearest
        return best if best.fit.error > (1 + ALIKE) * self.judge.floor else None

    def add(self, found: Found) -> None:
        """Fit a set; where it is the nearest, fit its parts from there: they are nested in it."""
        near = self.nearest.fit if self._by_key else None
        self._keep(found, self.judge.fit(found, near, multi_start=len(self._by_key) < 2))
        if self.nearest.found.key == found.key:
            self._add_parts(self.nearest)

    def promising(self, found: Found) -> list[Found]:
        """A set that is examined with each effect more that open-loop sensitivities promise to explain most."""
        fit = self._by_key[found.key].fit
        if fit.error < (1 + ALIKE) * self.judge.floor:
            return []
        ranked = expected_gains(self.judge, fit, found.lin.library)
        sets = [(gain, Found(found.lin, (*found.chosen, h))) for gain, h in ranked if compatible((*found.chosen, h))]
        least = RUNNER_UP * sets[0][0]
        new = {one.key: one for gain, one in reversed(sets) if gain > least and one.key not in self._by_key}
        return list(new.values())[: -PROMISING - 1 : -1]

    def go_on(self) -> None:
        """Go on with the nearest set's fit where it errs by more than the sensors."""
        if (best := self.unexplained) is not None:
            self._keep(best.found, self.judge.further(best.found, best.fit))

    def settle(self) -> None:
        """Fit the baseline from where the nearest set ended, and parts of all sets that may be named."""
        best, base = self.nearest, self.examined[0]
        if best is not base:
            self._keep(base.found, self.judge.further(base.found, best.fit))
        for one in self.examined:
            if not is_farther(one.candidate, best.candidate, ALIKE * log(base.fit.error / best.fit.error)):
                self._add_parts(one, missing=True)

    def _add_parts(self, whole: Examined, missing: bool = False) -> None:
        for part in (whole.found.with_only(h) for h in whole.found.chosen if len(whole.found.chosen) > 1):
            if not (missing and part.key in self._by_key):
                self._keep(part, self.judge.fit(part, whole.fit))

    def _keep(self, found: Found, fit: Fitted) -> None:
        """The nearer fit of a set."""
        new = Examined(found, fit)
        self._by_key[found.key] = min(self._by_key.get(found.key, new), new, key=_error)


def _error(one: Examined) -> float:
    return one.fit.error


def _distinct(sets: Sequence[Found]) -> list[Found]:
    """The most probable state of each set of effects."""
    best: dict[frozenset[object], Found] = {}
    for one in sorted(sets, key=lambda one: one.log_evidence):
        best[one.key] = one
    return list(best.values())

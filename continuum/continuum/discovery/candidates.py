"""The search from recordings to candidates: baseline, screening, fits."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from math import log

import numpy as np

from continuum.discovery.decision import ALIKE, CHANCE, PRICE, is_farther, is_needless, is_probable, is_worth
from continuum.discovery.examination import Examination, Examined
from continuum.discovery.fit_result import Fitted
from continuum.discovery.hand_measurement import HandMeasurement
from continuum.discovery.mirrored_joints import mirrored
from continuum.discovery.output_error import OutputError
from continuum.discovery.refit import problem_for, refit
from continuum.discovery.score_test import Promise, promises
from continuum.discovery.search import (
    MOST,
    RUNNER_UP,
    Found,
    Progress,
    with_library,
    with_linear,
    with_one_more,
    with_unseen,
)
from continuum.discovery.sensitivities import is_linear
from continuum.dynamics.model import Model
from continuum.languages import Message
from continuum.recordings.recording import Recording


def silent(_what: str, _share: float) -> None:
    """Report no progress."""


def examine(
    recordings: Sequence[Recording],
    model: Model,
    effects: Sequence[str] | None = None,
    progress: Progress = silent,
    measured: Sequence[HandMeasurement] = (),
    zeroed: Collection[int] = (),
) -> Examination:
    """Search for sets of effects and simulate each open loop; ``model`` includes the values measured by hand."""
    progress(Message("compiling"), 0.0)
    problem = replace(problem_for(recordings, model, effects, measured), zeroed=frozenset(zeroed))
    progress(Message("baseline"), 0.1)
    fits = _Fits(*refit(problem, recordings), progress)
    fits.search()
    base, *others = fits.examined
    return Examination(fits.judge.problem, fits.judge, base, tuple(others), tuple(fits.log))


class _Fits:
    """Fits of sets, the baseline first, and the search among sets."""

    def __init__(self, start: Examined, judge: OutputError, other: OutputError | None, progress: Progress) -> None:
        self.judge, self._by_other_inputs, self.log = judge, other, list[str]()
        self._problem, self._progress = judge.problem, progress
        self._by_key: dict[frozenset[object], Examined] = {}
        if start.found.chosen:
            baseline = Found(start.found.lin, ())
            self._keep(baseline, judge.fit(baseline, [start.fit]))
        self._by_key[start.found.key] = start
        self._expanded: set[frozenset[object]] = set()
        self._exchanged: set[frozenset[object]] = set()

    @property
    def examined(self) -> list[Examined]:
        """All sets that were fitted."""
        return list(self._by_key.values())

    @property
    def nearest(self) -> Examined:
        """The set with the least error, with a price on its effects."""
        observations = min(self.examined, key=_error).fit.observations

        def cost(one: Examined) -> float:
            return PRICE * len(one.found.chosen) + one.fit.occam + observations * log(one.fit.error)

        possible = [one for one in self.examined if np.isfinite(one.fit.error) and one.candidate.zeros > CHANCE]
        return min(possible, key=cost, default=self.examined[0])

    def search(self) -> None:
        """Add one effect at a time to the nearest set while it errs by more than the sensors; then fit alternatives."""
        best = None
        while best is not self.nearest:
            while (about := self._to_expand()) is not None:
                self._expand(about)
                nearest = self.nearest
                if self._is_unexplained(nearest) and not nearest.fit.settled:
                    self._keep(nearest.found, self.judge.further(nearest.found, nearest.fit))
                self._reconsider_inputs()
            best = self.nearest
            self._refit_baseline()
            if best is self.nearest:
                self._add_parts(best, missing=True)
                self._mirror(best)
                self._exchange(best)
        self._settle()

    def add(self, found: Found, near: Sequence[Fitted]) -> None:
        """Fit a set; if it is the nearest, fit its parts from its optimum: they are nested in it."""
        self._keep(found, self.judge.fit(found, near))
        if self.nearest.found.key == found.key:
            self._add_parts(self.nearest)

    def _is_unexplained(self, one: Examined) -> bool:
        return one.fit.error > (1 + ALIKE) * self.judge.floor

    def _to_expand(self) -> Examined | None:
        best = self.nearest
        effects, done = best.found.effects, best.found.key in self._expanded
        return best if effects < MOST and not done and (self._is_unexplained(best) or not effects) else None

    def _expand(self, about: Examined) -> None:
        """Fit sets with one more effect."""
        self._expanded.add(about.found.key)
        found = self._with_library(about)
        ranked = promises(self.judge, about.fit, found.lin.library)
        self.log.append(f"about {found.label}: {_labels(ranked)}")
        worth = [one for one in ranked if is_worth(one.gain / RUNNER_UP, one.observations)]
        if not worth and self._is_unexplained(about):
            worth = ranked[:1]  # far from the truth few residuals are independent, and steps are too short
        gains = [(one.gain, one.hypothesis) for one in worth]
        for number, one in enumerate(with_one_more(self._problem, found, gains)):
            self._progress(
                Message("simulating with {set}", set=one.label), 0.3 + 0.05 * number + 0.2 * bool(found.chosen)
            )
            self._try(one, about)
        stays = self.nearest.found.key == about.found.key and self._is_unexplained(about)
        for one in with_unseen(self._problem, found) if stays else []:
            self._progress(Message("simulating with {set}", set=one.label), 0.7)
            self._try(one, about)

    def _mirror(self, best: Examined) -> None:
        """On an arm with two joints, fit the other joint too: less friction at one equals more at the other."""
        for one in best.found.chosen:
            if (twin := mirrored(best.fit, one, best.found.lin.library, self._problem.coordinates)) is not None:
                found = Found(best.found.lin, (*(h for h in best.found.chosen if h is not one), twin[0]))
                self._keep(found, self.judge.fit(found, [twin[1]]))

    def _exchange(self, best: Examined) -> None:
        """Fit sets in which another effect replaces one of the best set's, starting one step from that set."""
        chosen, gained = best.found.chosen, log(self.examined[0].fit.error / best.fit.error)
        for left in filter(is_linear, chosen if is_probable(best.candidate, self.examined[0].candidate) else ()):
            rest = with_library(self._problem, best.found.without(left))
            ranked = promises(self.judge, best.fit, rest.lin.library, left)
            self.log.append(f"in {best.found.label} for {left.label}: {_labels(ranked)}")
            near = {one.hypothesis: one.near for one in ranked}
            alike = [
                (one.gain + gained, one.hypothesis)
                for one in ranked
                if one.gain > (RUNNER_UP - 1) * gained and self._lacks(rest, one, best, gained)
            ]
            for one in with_linear(rest, alike):
                self._progress(Message("simulating with {set}", set=one.label), 0.8)
                self._exchanged.add(one.key)
                self.add(one, [near[one.chosen[-1]]])

    def _lacks(self, rest: Found, one: Promise, best: Examined, gained: float) -> bool:
        """Whether a set is not fitted, or not as well as a step from the best set promises.

        A fit that started from such a step is at its optimum: then the promise was too large.
        """
        key = rest.key | {one.hypothesis.key}
        known = self._by_key.get(key)
        return known is None or (
            key not in self._exchanged and log(known.fit.error / best.fit.error) > ALIKE * gained - one.gain
        )

    def _with_library(self, one: Examined) -> Found:
        """Return a set with all hypotheses about it; the baseline has them already."""
        return with_library(self._problem, one.found) if one.found.chosen else one.found

    def _try(self, found: Found, about: Examined) -> None:
        """Fit a set unless it was fitted before, starting from the set that it extends and from the nearest set."""
        if found.key not in self._by_key:
            self.add(found, [about.fit, *([self.nearest.fit] if self.nearest.fit is not about.fit else [])])

    def _reconsider_inputs(self) -> None:
        """Switch between held and linear inputs if that lowers the nearest set's error.

        A set without effects, or one that explains the recordings, does not decide this.
        """
        best, other = self.nearest, self._by_other_inputs
        if other is None or not best.found.chosen or not self._is_unexplained(best):
            return
        fit = other.fit(best.found, [best.fit])
        if fit.error < best.fit.error:
            self.judge, self._by_other_inputs, self._problem = other, self.judge, other.problem
            for one in self.examined:
                again = fit if one is best else other.fit(one.found, [one.fit])
                self._by_key[one.found.key] = Examined(one.found, again)

    def _refit_baseline(self) -> None:
        """Refit the baseline, starting from the set with the least error."""
        best, base = min(self.examined, key=_error), self.examined[0]
        if best is not base:
            self._keep(base.found, self.judge.further(base.found, best.fit, base.fit.error))

    def _settle(self) -> None:
        """Bring all sets that the verdict may name to their optimum, then fit their parts."""
        for one in self._nameable():
            self._converge(one)
        for one in self._nameable():
            self._add_parts(one, missing=True)

    def _nameable(self) -> list[Examined]:
        """Return the sets whose error is not significantly above the least and whose effects are all needed."""
        sets = [one for one in self.examined[1:] if one.candidate.zeros > CHANCE]
        best = min([self.examined[0], *sets], key=_error)
        alike = ALIKE * log(self.examined[0].fit.error / best.fit.error)
        fitted = [one.candidate for one in sets]
        near = [one for one in sets if not is_farther(one.candidate, best.candidate, alike)]
        return [one for one in near if not is_needless(one.candidate, fitted, alike)]

    def _converge(self, one: Examined) -> None:
        """Continue a fit while its error falls: a set short of its optimum makes others seem as good."""
        key = one.found.key
        while self._is_unexplained(one := self._by_key[key]) and not one.fit.settled:
            self._progress(Message("simulating with {set}", set=one.found.label), 0.85)
            self._keep(one.found, self.judge.further(one.found, one.fit))
            if self._by_key[key] is one or log(one.fit.error / self._by_key[key].fit.error) < ALIKE:
                return

    def _add_parts(self, whole: Examined, missing: bool = False) -> None:
        for part in (whole.found.without(h) for h in whole.found.chosen if len(whole.found.chosen) > 1):
            if not (missing and part.key in self._by_key):
                self._keep(part, self.judge.fit(part, [whole.fit]))

    def _keep(self, found: Found, fit: Fitted) -> None:
        """Keep the fit of a set with the lower error."""
        new = Examined(found, fit)
        self._by_key[found.key] = min(self._by_key.get(found.key, new), new, key=_error)


def _labels(ranked: Sequence[Promise]) -> str:
    return ", ".join(f"{one.hypothesis.label} {one.gain:.2f}" for one in ranked[:5])


def _error(one: Examined) -> float:
    return one.fit.error

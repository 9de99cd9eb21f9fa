"""The order of a search and what it keeps, on trials made by hand: whoever is asked for a fit gives a known one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np
import pytest
from discovery_fits import EFFECTS, Fits, effects_of
from discovery_laws import RUNS, SIZE, WINDOWS, trial

from continuum.discovery.evidence import gain, unexplained
from continuum.discovery.judgement import judge
from continuum.discovery.search import Earlier, search, tell_nobody
from continuum.discovery.trial import Trial
from continuum.discovery.verdict import Kind
from continuum.discovery.window_beginnings import with_beginnings_of
from continuum.discovery.workers import FIRST_LOOK, LONG_LOOK, Task
from continuum.identification.arrow_least_squares import FitStatus


def test_nothing_is_added_where_nothing_helps() -> None:
    baseline, rounds = search(Fits({(): 0.3}), EFFECTS, lambda _what, _part: None)
    assert baseline.extension == ()
    assert len(rounds) == 1
    assert rounds[0].best is rounds[0].before is baseline


def test_one_effect_that_leaves_noise_ends_the_search() -> None:
    fits = Fits({(): 0.3, ("base_tilt",): 0.0})
    _, rounds = search(fits, EFFECTS, lambda _what, _part: None)
    assert [effects_of(one.best.extension) for one in rounds] == [["base_tilt"]]
    assert not any(len(task.extension) > 1 for task in fits.asked)


def test_luck_in_one_run_hides_no_effect_that_helps_in_all() -> None:
    fits = Fits({(): 0.3, ("tip_payload",): 0.3, ("base_tilt",): 0.2, ("quadratic_drag",): 0.3})
    fitted = fits.fitted

    def lucky(task: Task) -> Trial:
        made = fitted(task)
        if effects_of(task.extension) != ["tip_payload"]:
            return made
        first, *others = trial(bad=0.3).held_out  # as without any effect
        return replace(made, held_out=(np.minimum(first, 0.5 * SIZE), *others), cost=3200.0)

    fits.fitted = lucky  # type: ignore[method-assign]
    _, rounds = search(fits, EFFECTS, lambda _what, _part: None)
    before, (tilt, payload, *_) = rounds[0].before, rounds[0].leaders
    assert effects_of(rounds[0].best.extension) == effects_of(tilt.extension) == ["base_tilt"]
    assert effects_of(payload.extension) == ["tip_payload"]
    assert gain(payload, before).log_likelihood > gain(tilt, before).log_likelihood
    assert not gain(payload, before).is_significant
    assert all(cause.addition.effect != "tip_payload" for cause in judge(before, rounds).alternatives)


def test_windows_that_are_explained_badly_begin_as_where_they_are_explained_best() -> None:
    """States of effects that there are not stay; what is explained as well as elsewhere begins as it did."""
    n = RUNS * WINDOWS
    mine, other = (
        replace(one, own=tuple(np.full(size, value) for _ in range(n)))
        for one, size, value in ((trial("backlash", bad=0.1), 6, 1.0), (trial(bad=0.0), 4, 2.0))
    )
    begun = with_beginnings_of(mine, [other])
    for here, there, relative in zip(mine.own, begun.own, mine.relative, strict=True):
        wanted = [2.0, 2.0, 2.0, 2.0, 1.0, 1.0] if relative > 2 else here
        np.testing.assert_array_equal(there, wanted)
    assert sum(own[0] == 2.0 for own in begun.own) == round(0.1 * n)
    assert all(own.size == 4 for own in with_beginnings_of(replace(mine, own=other.own), [mine]).own)


def test_what_the_model_without_it_gains_by_the_same_search_is_no_gain() -> None:
    """Fitted anew from where the effect's fit ended, the baseline does as well: nothing was missing."""
    shares = {(): 0.3, ("base_tilt",): 0.0}
    baseline, rounds = search(Fits(shares, {(): 0.0}), EFFECTS, lambda _what, _part: None)
    assert rounds[0].best is rounds[0].before is baseline
    np.testing.assert_array_less(baseline.relative, 2.0)


def test_effects_are_looked_at_for_longer_where_first_looks_promise_nothing() -> None:
    for hidden, longer in ((0.3, True), (0.0, False)):
        fits = Fits({(): hidden, ("base_tilt",): 0.0})
        fitted = fits.fitted

        def in_vain(task: Task, fitted: Callable[[Task], Trial] = fitted) -> Trial:
            first = task.is_look and task.iterations == FIRST_LOOK
            return replace(fitted(replace(task, extension=())), extension=task.extension) if first else fitted(task)

        fits.fitted = in_vain  # type: ignore[method-assign]
        _, rounds = search(fits, EFFECTS, lambda _what, _part: None)
        assert any(task.is_look and task.iterations == LONG_LOOK for task in fits.asked) == longer
        assert (effects_of(rounds[0].best.extension) == ["base_tilt"]) == longer
        assert not any(task.closely for task in fits.asked)  # noise, or all explained


@pytest.mark.parametrize("hidden", [0.4, 0.6])
def test_windows_begin_afresh_where_the_model_is_very_wrong(hidden: float) -> None:
    """In the first round: looks, leaders, and once more the model as it is; what helps has good enough ones then."""
    fits = Fits({(): hidden, ("tip_payload",): 0.1, ("tip_payload", "base_tilt"): 0.0, ("base_tilt",): 0.5})
    _, rounds = search(fits, EFFECTS, lambda _what, _part: None)
    afresh = {(len(task.extension), task.is_look, task.find_joints) for task in fits.asked if task.afresh}
    assert afresh == ({(n, look, False) for n in (0, 1) for look in (True, False)} if hidden > 0.5 else set())
    assert len(rounds[-1].best.extension) == 2


@pytest.mark.parametrize("left", [0.0, 0.25])
@pytest.mark.parametrize("found_closely", [True, False])
@pytest.mark.parametrize("hidden", [0.4, 0.6])
def test_a_first_effect_that_explains_little_is_sought_once_more_by_close_looks(
    hidden: float, found_closely: bool, left: float
) -> None:
    """Which are long, and windows begin in them as in the refitted model; nothing is looked at closely but for that."""
    fits = Fits({(): hidden, ("base_tilt",): hidden - 0.3 + left, ("tip_payload",): hidden - 0.02})
    fitted = fits.fitted

    def one_way(task: Task) -> Trial:
        is_vain = effects_of(task.extension) == ["base_tilt"] and task.is_look and task.closely != found_closely
        return trial("base_tilt", bad=0.7) if is_vain else fitted(task)

    fits.fitted = one_way  # type: ignore[method-assign]
    _, rounds = search(fits, EFFECTS, lambda _what, _part: None)
    assert effects_of(rounds[0].best.extension) == ["base_tilt"]
    close = [task for task in fits.asked if task.closely]
    assert bool(close) == (found_closely or left > 0)
    assert all(task.is_look and task.iterations == LONG_LOOK and not task.afresh for task in close)
    assert all(len(task.extension) < 2 for task in fits.asked if task.afresh or task.closely)


def test_what_a_fresh_start_gains_is_no_gain_of_an_effect() -> None:
    fits = Fits({(): 0.6, ("tip_payload",): 0.3})
    fitted = fits.fitted

    def better_afresh(task: Task) -> Trial:
        is_it = task.afresh and not task.is_look and not task.extension
        return replace(trial(bad=0.3), extension=()) if is_it else fitted(task)

    fits.fitted = better_afresh  # type: ignore[method-assign]
    baseline, rounds = search(fits, EFFECTS, lambda _what, _part: None)
    assert rounds[0].best is rounds[0].before is baseline
    assert unexplained(baseline) == pytest.approx(0.3, abs=0.01)


def test_the_best_of_those_that_are_still_behind_is_fitted_to_the_end() -> None:
    fits = Fits({(): 0.3, ("base_tilt",): 0.0})
    fitted = fits.fitted

    def slow(task: Task) -> Trial:
        return fitted(task) if task.is_look or task.find_joints or not task.extension else trial("base_tilt", bad=0.4)

    fits.fitted = slow  # type: ignore[method-assign]
    _, rounds = search(fits, EFFECTS, lambda _what, _part: None)
    assert effects_of(rounds[0].best.extension) == ["base_tilt"]


def test_progress_goes_from_nothing_to_done() -> None:
    told: list[tuple[str, float]] = []
    search(Fits({(): 0.3, ("base_tilt",): 0.0}), EFFECTS, lambda what, part: told.append((what, part)))
    assert told[0][1] == 0.0
    assert told[-1] == ("effects sought", 1.0)
    assert all(0 <= part <= 1 for _, part in told)


def test_an_effect_that_the_model_has_is_not_tried_twice() -> None:
    fits = Fits({(): 0.4, ("tip_payload",): 0.2})
    search(fits, EFFECTS, lambda _what, _part: None)
    assert all(len({a.effect for a in task.extension}) == len(task.extension) for task in fits.asked)


def test_a_search_asks_whether_to_go_on_with_what_it_found() -> None:
    fits = Fits({(): 0.5, ("tip_payload",): 0.3, ("tip_payload", "base_tilt"): 0.0})
    asked: list[list[str]] = []

    def after_one(best: Trial) -> bool:
        asked.append(effects_of(best.extension))
        return True

    _, rounds = search(fits, EFFECTS, lambda _what, _part: None, after_one)
    assert asked == [["tip_payload"]]
    assert [effects_of(one.best.extension) for one in rounds] == [["tip_payload"]]


def test_a_search_asks_where_nothing_helps_too() -> None:
    asked: list[list[str]] = []
    search(
        Fits({(): 0.3}), EFFECTS, lambda _what, _part: None, lambda best: bool(asked.append(effects_of(best.extension)))
    )
    assert asked == [[]]


def test_what_an_earlier_search_found_leads_wherever_its_look_promises_nothing() -> None:
    fits = Fits({(): 0.3, ("tip_payload",): 0.25, ("base_tilt",): 0.0})
    fitted = fits.fitted

    def in_vain(task: Task) -> Trial:
        made = fitted(task)
        return fitted(replace(task, extension=())) if task.is_look else made

    fits.fitted = lambda task: replace(in_vain(task), extension=task.extension)  # type: ignore[method-assign]
    _, rounds = search(fits, EFFECTS, tell_nobody)
    assert effects_of(rounds[0].best.extension) == []
    earlier = Earlier(trial(bad=0.3), trial("base_tilt", bad=0.0))
    _, rounds = search(fits, EFFECTS, tell_nobody, earlier=earlier)
    assert effects_of(rounds[0].best.extension) == ["base_tilt"]
    assert [task for task in fits.asked if task.near is earlier.best] == [
        Task(earlier.best.extension, earlier.best, 20, True)
    ]
    assert any(task.near is earlier.baseline for task in fits.asked if not task.extension)


def test_a_search_begins_without_an_effect_where_the_one_before_it_ended_so() -> None:
    fits = Fits({(): 0.0})
    earlier = Earlier(trial(bad=0.3), trial(bad=0.0))
    search(fits, EFFECTS, lambda _what, _part: None, earlier=earlier)
    assert fits.asked[0].near is earlier.best


class SlowFits:
    """Payload and tilt explain all after so many iterations, one as well as the other; `simulations` counts these."""

    def __init__(self, needed: int) -> None:
        self._needed = needed

    def __call__(self, tasks: Sequence[Task]) -> Iterator[Trial]:
        for task in tasks:
            effect, near = (effects_of(task.extension) or [""])[-1], task.near
            is_on = near is not None and near.extension[-1:] == task.extension[-1:]
            done = task.iterations + (near.simulations if near is not None and is_on else 0)
            left = max(1 - done / self._needed, 0.0) if effect in ("tip_payload", "base_tilt") else 1.0
            made = trial(*effects_of(task.extension), bad=0.3 * left)
            yield replace(made, cost=made.misfit / 2, simulations=done, status=FitStatus.NO_CONVERGENCE)


@pytest.mark.parametrize("needed", [LONG_LOOK, 20, 28])
def test_an_effect_that_leads_from_the_start_hides_no_rival(needed: int) -> None:
    earlier = Earlier(replace(trial(bad=0.3), simulations=0), replace(trial("tip_payload"), simulations=100))
    baseline, rounds = search(SlowFits(needed), EFFECTS, lambda _what, _part: None, earlier=earlier)
    verdict = judge(baseline, rounds)
    assert verdict.kind is Kind.AMBIGUOUS
    assert {c.addition.effect for c in (*verdict.causes, *verdict.alternatives)} == {"tip_payload", "base_tilt"}


@pytest.mark.parametrize(("left_by_two", "sought"), [(0.2, 3), (0.4, 2)])
def test_a_third_effect_is_sought_where_two_left_little(left_by_two: float, sought: int) -> None:
    shares = {(): 0.6, ("tip_payload",): 0.5, ("base_tilt",): 0.55, ("tip_payload", "base_tilt"): left_by_two}
    _, rounds = search(Fits(shares | {EFFECTS: 0.0}), EFFECTS, lambda _what, _part: None)
    assert len(rounds) == sought


def test_no_more_is_sought_where_the_last_effect_explained_little_of_what_is_left() -> None:
    little = {(): 0.9, ("tip_payload",): 0.83, ("base_tilt",): 0.85, ("tip_payload", "base_tilt"): 0.0}
    _, rounds = search(Fits(little), EFFECTS, lambda _what, _part: None)
    assert [effects_of(one.best.extension) for one in rounds] == [["tip_payload"]]
    shares = {(): 0.9, ("tip_payload",): 0.3, ("base_tilt",): 0.85, ("tip_payload", "base_tilt"): 0.26, EFFECTS: 0.0}
    _, rounds = search(Fits(shares), EFFECTS, lambda _what, _part: None)
    assert len(rounds) == 2


def test_what_explains_nearly_all_names_every_effect_of_its_model() -> None:
    both = ("tip_payload", "base_tilt")
    shares = {(): 0.6, ("tip_payload",): 0.3, ("base_tilt",): 0.5, both: 0.1}
    baseline, rounds = search(Fits(shares), EFFECTS, lambda _what, _part: None)
    verdict = judge(baseline, rounds)
    assert verdict.to_close == 0.8
    assert {cause.addition.effect for cause in verdict.causes} == set(both)
    assert set(effects_of(verdict.extension)) == set(both)

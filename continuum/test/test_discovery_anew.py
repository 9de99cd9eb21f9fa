"""Where a second effect is found, the first is sought anew beside it: what stays, what goes, what cannot be told."""

from __future__ import annotations

from dataclasses import replace

import pytest
from discovery_fits import EFFECTS, Fits, effects_of
from discovery_laws import trial

from continuum.discovery.judgement import judge
from continuum.discovery.search import search
from continuum.discovery.trial import Trial
from continuum.discovery.verdict import Kind
from continuum.discovery.workers import Task


def test_two_effects_are_found_and_the_first_is_sought_anew_beside_the_second() -> None:
    both = ("tip_payload", "base_tilt")
    fits = Fits({(): 0.4, ("tip_payload",): 0.2, ("base_tilt",): 0.3, both: 0.0})
    _, rounds = search(fits, EFFECTS, lambda _what, _part: None)
    assert set(effects_of(rounds[-1].best.extension)) == set(both)
    assert fits.times("base_tilt", "tip_payload") > 0
    assert rounds[-1].best is not rounds[-1].before


def test_a_second_effect_that_is_small_beside_the_first_leaves_it_where_it_is() -> None:
    both = ("tip_payload", "base_tilt")
    fits = Fits({(): 0.6, ("tip_payload",): 0.1, ("base_tilt",): 0.6, both: 0.1})
    fitted = fits.fitted

    def a_little_better(task: Task) -> Trial:
        made = fitted(task)
        if effects_of(task.extension) != ["tip_payload", "base_tilt"]:
            return made
        return replace(made, held_out=tuple(0.97 * run for run in made.held_out), cost=0.97 * made.cost)

    fits.fitted = a_little_better  # type: ignore[method-assign]
    _, rounds = search(fits, EFFECTS, lambda _what, _part: None)
    assert [effects_of(one.best.extension) for one in rounds[:2]] == [["tip_payload"], ["tip_payload", "base_tilt"]]
    assert rounds[1].best is not rounds[1].before
    assert fits.times("base_tilt", "tip_payload") == 0


def test_a_first_effect_that_the_second_makes_needless_is_dropped() -> None:
    """The drag helped only as long as the payload was unknown."""
    late = {(): 0.5, ("quadratic_drag",): 0.2, ("tip_payload",): 0.4, ("quadratic_drag", "tip_payload"): 0.0}
    fits = Fits(late, {})
    fitted = fits.fitted

    def alone_is_enough(task: Task) -> Trial:
        if effects_of(task.extension) == ["tip_payload"] and task.near is not None and len(task.near.extension) == 2:
            return replace(trial("tip_payload", bad=0.0, seed=1), cost=0.0)
        return fitted(task)

    fits.fitted = alone_is_enough  # type: ignore[method-assign]
    _, rounds = search(fits, EFFECTS, lambda _what, _part: None)
    assert [effects_of(one.best.extension) for one in rounds] == [["tip_payload"], ["tip_payload"]]
    assert rounds[1].best is rounds[1].before
    led = [effects_of(one.extension)[-1] for one in rounds[0].leaders]
    assert len(set(led)) == len(led)


LED_ASTRAY = {
    (): 0.6, ("tip_payload",): 0.4, ("base_tilt",): 0.45, ("tip_payload", "base_tilt"): 0.2,
    ("base_tilt", "quadratic_drag"): 0.0, ("quadratic_drag",): 0.6, ("tip_payload", "quadratic_drag"): 0.6,
}  # fmt: skip
"""The payload leads, the tilt is found beside it, and beside the tilt the drag."""


def test_an_effect_that_the_one_sought_anew_makes_needless_is_dropped() -> None:
    fits = Fits(LED_ASTRAY, {("quadratic_drag",): 0.0})
    baseline, rounds = search(fits, EFFECTS, lambda _what, _part: None)
    assert [effects_of(one.best.extension) for one in rounds] == [["quadratic_drag"]]
    assert rounds[0].before is baseline
    assert judge(baseline, rounds).kind is Kind.CAUSE


@pytest.mark.parametrize(
    ("alone", "others"),
    [
        (0.25, {}),  # it needs the tilt
        (0.05, {}),  # nearly not
        (0.0, {("tip_payload", "base_tilt"): 0.01}),  # it is no better than the first two
        (0.0, {("base_tilt", "backlash"): 0.0}),  # another one is as good beside the tilt
    ],
)
def test_an_effect_that_may_be_needed_stays(alone: float, others: dict[tuple[str, ...], float]) -> None:
    fits = Fits(LED_ASTRAY | {("backlash",): 0.6} | others, {("quadratic_drag",): alone})
    baseline, rounds = search(fits, (*EFFECTS, "backlash"), lambda _what, _part: None)
    assert [effects_of(one.best.extension) for one in rounds[:2]] == [
        ["tip_payload", "base_tilt"], ["base_tilt", "quadratic_drag"]
    ]  # fmt: skip
    verdict = judge(baseline, rounds)
    named = {cause.addition.effect for cause in (*verdict.causes, *verdict.alternatives)}
    assert "base_tilt" in named
    if ("base_tilt", "backlash") in others:
        assert verdict.kind is Kind.AMBIGUOUS


def test_what_stands_alone_is_sought_anew_beside_what_comes_next() -> None:
    left = LED_ASTRAY | {("base_tilt", "quadratic_drag"): 0.08, ("quadratic_drag", "backlash"): 0.0, ("backlash",): 0.5}
    fits = Fits(left, {("quadratic_drag",): 0.08})
    _, rounds = search(fits, (*EFFECTS, "backlash"), lambda _what, _part: None)
    assert set(effects_of(rounds[-1].best.extension)) == {"quadratic_drag", "backlash"}
    assert fits.times("backlash", "quadratic_drag") > 0


def test_of_two_that_do_as_well_beside_a_small_second_effect_none_is_named_alone() -> None:
    """The first round alone tells them apart, and it did not know the second effect."""
    shares = {
        (): 1.0, ("quadratic_drag",): 0.08, ("tip_payload",): 0.14, ("base_tilt",): 0.99,
        ("quadratic_drag", "base_tilt"): 0.0, ("tip_payload", "base_tilt"): 0.0,
    }  # fmt: skip
    baseline, rounds = search(Fits(shares), EFFECTS, lambda _what, _part: None)
    verdict = judge(baseline, rounds)
    assert verdict.kind is Kind.AMBIGUOUS
    assert {c.addition.effect for c in (*verdict.causes, *verdict.alternatives)} == set(EFFECTS)

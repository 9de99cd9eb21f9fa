"""Figures of results made by hand, and the page around them."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import pytest
from blind.plant import EFFECTS

from tools.bench_discovery.answer import Answer
from tools.bench_discovery.calibration import bins, expected_error, statements
from tools.bench_discovery.estimates import coverage, estimates, median_error
from tools.bench_discovery.goals import MET, MISSED, TOO_FEW, at_least, at_most, goals
from tools.bench_discovery.page import page
from tools.bench_discovery.rate import Rate
from tools.bench_discovery.reasons import REASONS
from tools.bench_discovery.result import Result
from tools.bench_discovery.score import (
    ambiguous_sets,
    by_size,
    confusion,
    losses,
    name_of,
    quantile,
    smallest_found,
    tallies,
    tally,
)
from tools.bench_discovery.test.results_by_hand import effect, named, result, verdict

DELAY, TILT = effect("sensor_delay", amount=0.02), effect("base_tilt")
FOUND = result([DELAY], verdict("cause", named("sensor_delay", delay=(0.021, 0.019, 0.023))))
UNSURE = result(
    [DELAY],
    verdict("ambiguous", named("actuator_lag", confidence=0.6), others=(named("sensor_delay", confidence=0.4),)),
)
WRONG = result([TILT], verdict("cause", named("rest_angle", 1, 0.7)))
CLEAN = result([], verdict("adequate"))
ALARM = result([], verdict("cause", named("base_tilt", confidence=0.55), after=0.5))
STRANGE = result([effect("magnet", 3, 0.2)], verdict("unknown", named("backlash", 3, 1.0)))
BOTH = result([DELAY, TILT], verdict("cause", named("base_tilt"), named("sensor_delay")))
NONE = result([TILT], None)
ALL = [FOUND, UNSURE, WRONG, CLEAN, ALARM, STRANGE, BOTH, NONE]


def test_rates_have_wilsons_intervals() -> None:
    low, high = Rate(8, 10).interval
    assert (low, high) == (pytest.approx(0.4902, abs=1e-4), pytest.approx(0.9433, abs=1e-4))
    assert Rate(0, 0).interval == (0.0, 1.0)
    assert str(Rate(8, 10)) == "80 % (49 to 94, n 10)"
    assert Rate.of([True, False, True]) == Rate(2, 3)


def test_an_ambiguous_set_is_never_right() -> None:
    found = tally([FOUND, UNSURE])
    assert found.right == Rate(1, 2)
    assert found.right_or_set == Rate(2, 2)


def test_groups_with_wrong_causes_come_first() -> None:
    groups = tallies([FOUND, UNSURE, WRONG], name_of)
    assert list(groups) == ["base_tilt", "sensor_delay"]
    assert groups["base_tilt"].wrong == Rate(1, 1)


def test_confusion() -> None:
    matrix = confusion(ALL)
    assert list(matrix) == ["base_tilt", "sensor_delay", "magnet", "nothing"]
    assert matrix["base_tilt"] == {"rest_angle": 1, "no verdict": 1}
    assert matrix["sensor_delay"] == {"sensor_delay": 1, "ambiguous": 1}
    assert matrix["nothing"] == {"adequate": 1, "base_tilt": 1}
    assert ambiguous_sets(ALL) == {"sensor_delay": {"actuator_lag, sensor_delay": 1}}


def sized(k: dict[str, int], n: int) -> list[Result]:
    missed = replace(FOUND, verdict=verdict("adequate"))
    return [
        replace(case, plan=replace(case.plan, size=size))
        for size, right in k.items()
        for case in [FOUND] * right + [missed] * (n - right)
    ]


@pytest.mark.parametrize(
    ("k", "n", "found"),
    [
        ({"small": 1, "medium": 4, "large": 4}, 4, "-"),
        ({"small": 10, "medium": 10, "large": 9}, 10, "0.006 s or less"),
        ({"small": 0, "medium": 5, "large": 8}, 10, "more than 0.045 s"),
        ({"small": 8, "medium": 10, "large": 10}, 10, "0.01 s"),  # halfway from 0.006 to 0.018 along the logarithm
        ({"small": 10, "medium": 8, "large": 10}, 10, "0.028 s"),
    ],
)
def test_the_smallest_size(k: dict[str, int], n: int, found: str) -> None:
    assert smallest_found(by_size(sized(k, n), "sensor_delay"), "sensor_delay") == found


def test_estimates_of_what_was_named() -> None:
    (one,) = estimates(ALL[:5])
    assert one.parameter == "sensor_delay.delay"
    assert one.error == pytest.approx(0.05)
    assert one.is_covered
    narrow = result([DELAY], verdict("cause", named("sensor_delay", delay=(0.026, 0.025, 0.027))))
    assert coverage(estimates([FOUND, narrow])) == Rate(1, 2)
    assert median_error(estimates([FOUND, narrow])) == pytest.approx(0.175)
    at_joint = result(
        [effect("rest_angle", 4, -0.06)], verdict("cause", named("rest_angle", 4, angle=(-0.06, -0.07, -0.05)))
    )
    assert [e.error for e in estimates([at_joint])] == [0.0]


def test_confidence_is_judged_by_what_is_there() -> None:
    stated = statements(ALL)
    assert len(stated) == 7  # an unknown cause is not stated
    by_confidence = {round(one.confidence, 2): one.rate for one in bins(stated)}
    assert by_confidence == {0.4: Rate(1, 1), 0.55: Rate(0, 1), 0.6: Rate(0, 1), 0.7: Rate(0, 1), 0.9: Rate(3, 3)}
    assert expected_error(stated) == pytest.approx((0.6 + 0.55 + 0.6 + 0.7 + 3 * 0.1) / 7)
    assert math.isnan(expected_error([]))


def test_losses() -> None:
    assert losses([CLEAN, ALARM, NONE]) == [0.0, pytest.approx(0.25)]
    assert losses([result([], verdict("cause", named("base_tilt"), after=None))]) == [math.inf]


def test_quantiles() -> None:
    assert [quantile([3.0, 1.0, 2.0, 4.0], part) for part in (0.0, 0.5, 0.75, 1.0)] == [1.0, 2.0, 3.0, 4.0]


@pytest.mark.parametrize(
    ("rate", "status"),
    [
        (Rate(10, 10), TOO_FEW),
        (Rate(1, 10), MISSED),
        (Rate(39, 40), MET),
        (Rate(37, 40), MISSED),
        (Rate(0, 0), TOO_FEW),
    ],
)
def test_a_goal_is_met_missed_or_open(rate: Rate, status: str) -> None:
    assert at_least("", 0.95, rate).status == status


@pytest.mark.parametrize(
    ("rate", "status"),
    [
        (Rate(0, 40), TOO_FEW),  # one of twenty would have shown in 60
        (Rate(0, 60), MET),
        (Rate(5, 60), MISSED),
        (Rate(9, 10), MISSED),
        (Rate(0, 0), TOO_FEW),
    ],
)
def test_that_something_is_rare_takes_more_cases(rate: Rate, status: str) -> None:
    assert at_most("", 0.05, rate).status == status


def test_goals_tell_the_worst_effect() -> None:
    lines = {goal.what: goal for goal in goals(ALL)}
    assert lines["a wrong cause or joint is named, whatever is hidden"].figure.startswith("25 %")
    assert "the effect least often named: `base_tilt`" in lines
    assert lines["nothing hidden: a false alarm"].figure.startswith("50 %")
    assert lines["two effects: exactly these"].figure.startswith("100 %")
    assert lines["outside of the library: unknown"].figure.startswith("100 %")


def test_the_page_holds_every_answer() -> None:
    text = page(ALL)
    assert "from 8 cases" in text
    assert "| base_tilt 0.1 rad | rest_angle@1 0.70 | releases | ordinary | 0 |" in text
    assert "| sensor_delay | {actuator_lag, sensor_delay} | 1 |" in text
    assert all(answer.value in text for answer in Answer)
    for table in re.findall(r"(?:^\|.*\|\n)+", text, re.MULTILINE):
        assert len({line.count("|") for line in table.splitlines()}) == 1


def test_the_page_says_why_an_effect_is_seldom_named() -> None:
    unnamed = result([effect("backlash", 2)], verdict("unknown"))
    _, _, why = page([FOUND, unnamed, NONE, STRANGE]).partition("## Why some are seldom named")
    why = why.partition("\n## ")[0]
    assert "- `backlash`: where joints stick" in why
    assert "- `base_tilt`: not looked into yet." in why
    assert why.count("- `") == 2
    assert set(REASONS) <= set(EFFECTS)


@pytest.mark.parametrize("one", ALL, ids=lambda one: f"{one.kind}, {one.plan.effects}")
def test_the_page_of_a_single_case(one: Result) -> None:
    assert "from 1 cases" in page([one])
    assert "nan" not in page([one])


def test_cases_that_no_version_was_mended_on_count_as_they_were_answered_first() -> None:
    hidden = [effect("rest_angle", 5)]
    right, wrong = (
        result(hidden, verdict("cause", named(name, 5)), seed=2024000083) for name in ("rest_angle", "angle_offset")
    )
    mended_on = result(hidden, verdict("cause", named("base_tilt")), seed=2023000001)
    _, _, text = page([right, mended_on], [wrong]).partition("## Goals, on cases that no version was mended on")
    unseen, _, whole = text.partition("## Goals, on all cases")
    goal = "| a wrong cause or joint is named, whatever is hidden | none wanted |"
    assert f"{goal} 50 %" in whole
    assert f"{goal} 100 %" in unseen
    assert "angle_offset@5" in unseen
    assert "base_tilt" not in unseen

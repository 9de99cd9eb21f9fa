"""Figures and the page of results that are made by hand."""

from __future__ import annotations

import math

import pytest

from tools.bench_discovery.figures import Rate, bins, estimates, expected_error, quantile
from tools.bench_discovery.page import page
from tools.bench_discovery.result import Result
from tools.bench_discovery.test.results_by_hand import effect, named, result, verdict

DELAY, TILT, MAGNET = effect("sensor_delay", amount=0.02), effect("base_tilt"), effect("magnet", 3, 0.2)
IS_DELAY, IS_TILT = [named("sensor_delay", delay=(0.021, 0.019, 0.023))], [named("base_tilt", angle=(0.2, 0.19, 0.21))]
FOUND = result([DELAY], verdict("cause", IS_DELAY))
UNSURE = result([DELAY], verdict("ambiguous", [named("actuator_lag")], IS_DELAY, p=(0.6, 0.4)))
WRONG = result([TILT], verdict("cause", [named("rest_angle", 1)], closed=0.5), size="small")
CLEAN = result([], verdict("adequate"))
ALARM = result([], verdict("unknown", complete=False))
STRANGE = result([MAGNET], verdict("unknown", complete=False), seconds=60.0)
BOTH = result([DELAY, TILT], verdict("cause", IS_TILT + IS_DELAY))
FAILED = result([TILT], None)
ALL = [FOUND, UNSURE, WRONG, CLEAN, ALARM, STRANGE, BOTH, FAILED]


def test_rates_have_wilsons_intervals() -> None:
    assert str(Rate(8, 10)) == "80.0 % (49.0 to 94.3)"
    assert str(Rate(0, 0)) == "-"
    assert Rate.of([True, False, True]) == Rate(2, 3)


def test_quantiles() -> None:
    assert [quantile([3.0, 1.0, 2.0, 4.0, math.nan], part) for part in (0.0, 0.5, 0.75, 1.0)] == [1.0, 2.0, 3.0, 4.0]
    assert math.isnan(quantile([], 0.5))


def test_estimates_of_what_was_named() -> None:
    assert [(one.parameter, one.truth, one.is_covered) for one in estimates(ALL)] == [
        ("sensor_delay.delay", 0.02, True),
        ("base_tilt.angle", 0.1, False),
        ("sensor_delay.delay", 0.02, True),
    ]
    far = result([effect("tension_scale", amount=0.1)], verdict("cause", [named("tension_scale", gain_2=(0.05, 0, 1))]))
    assert [one.truth for one in estimates([far])] == [0.05]
    elsewhere = result([effect("rest_angle", 4)], verdict("cause", [named("rest_angle", 3, angle=(0.1, 0.0, 0.2))]))
    assert estimates([elsewhere]) == []


def test_probabilities_are_judged_by_what_is_there() -> None:
    assert bins(ALL) == [(0.4, Rate(1, 1)), (0.6, Rate(0, 1)), (1.0, Rate(2, 3))]
    assert expected_error(bins(ALL)) == pytest.approx((0.6 + 0.6 + 1) / 5)
    assert math.isnan(expected_error([]))


def test_the_page_is_of_the_held_out_half_where_there_is_one() -> None:
    held_out = result([DELAY], verdict("cause", IS_DELAY), half="held-out")
    text = page([*ALL, held_out], earlier=2)
    assert "from 1 cases" in text
    assert "Development half only" not in text
    assert "2 earlier versions" in text
    assert "n 4; wrong causes 12.5 %" in " ".join(text.split())


@pytest.mark.parametrize("one", ALL, ids=lambda one: f"{one.plan.kind}, {one.answer.value}")
def test_the_page_of_a_single_case(one: Result) -> None:
    assert "nan" not in page([one])
    assert len(page([one]).splitlines()) < 150

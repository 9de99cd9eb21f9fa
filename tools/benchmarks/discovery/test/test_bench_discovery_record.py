"""Figures and the record of results that are made by hand."""

from __future__ import annotations

import math

import pytest

from tools.benchmarks.discovery.figures import Rate, bins, estimates, expected_error, quantile
from tools.benchmarks.discovery.result import Result
from tools.benchmarks.discovery.tables import record_of
from tools.benchmarks.discovery.test.results_by_hand import effect, named, result, verdict

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


def test_the_record_is_of_the_held_out_half_where_there_is_one() -> None:
    held_out = result([DELAY], verdict("cause", IS_DELAY), half="held-out")
    assert record_of([*ALL, held_out]).figures == record_of([held_out]).figures != record_of(ALL).figures


@pytest.mark.parametrize("one", ALL, ids=lambda one: f"{one.plan.kind}, {one.answer.value}")
def test_every_table_counts_a_single_case_once(one: Result) -> None:
    tables = record_of([one]).tables
    counts = {"kinds and levels": 1, "times": 1}
    for name, column in counts.items():
        assert {row[column] for row in tables[name].rows} == {"1"}
    assert len(tables["wrong causes and failures"].rows) == (one in (WRONG, FAILED))
    assert all(len(row) == len(of.head) for of in tables.values() for row in of.rows)


def test_a_wrong_cause_misses_its_goal_and_is_a_rate_with_its_cases() -> None:
    figure, *_ = record_of(ALL).figures
    assert (figure.is_met, figure.n, figure.value) == (False, len(ALL), 100 / len(ALL))
    assert record_of([FOUND]).figures[0].is_met

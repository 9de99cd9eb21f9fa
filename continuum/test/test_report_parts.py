"""What the page of a diagnosis is made of: charts, numbers, names, and how often verdicts were right."""

from __future__ import annotations

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.discovery.decision import Kind
from continuum.discovery.report.chart import Axes, Line, chart, shared
from continuum.discovery.report.names import effect_in_words, label_in_words, sets_in_words, value_in_words
from continuum.discovery.report.quantities import number, percent, scale_of, tenths, with_interval
from continuum.discovery.report.track_record import track_record
from continuum.dynamics.effect_lookup import effect_named, effect_names

SIZES = st.floats(1e-4, 1e4)


def points(d: str) -> list[np.ndarray]:
    """Pieces of an SVG's path, (n, 2) each."""
    return [np.array(re.findall(r"(-?[\d.]+) (-?[\d.]+)", piece), dtype=float) for piece in d.split("M")[1:]]


def axes(x: np.ndarray, *curves: np.ndarray) -> Axes:
    return Axes("a", "b", tuple(Line("before", x, y) for y in curves))


def test_a_chart_draws_its_data() -> None:
    """Back in the data's units the path passes all points within half a pixel."""
    x = np.linspace(0.0, 3.0, 500)
    y = 40 * np.cos(7 * x) + np.random.default_rng(1).normal(0, 2, x.size)
    drawn = chart(axes(x, y))
    (piece,) = points(drawn.paths[0][1])
    assert len(piece) < x.size
    ticks = np.array([(tick.at, float(tick.text.replace("−", "-"))) for tick in drawn.y_ticks])
    slope, start = np.polyfit(ticks[:, 0], ticks[:, 1], 1)
    along = drawn.left + (x - x[0]) / (x[-1] - x[0]) * (drawn.right - drawn.left)
    off = (start + slope * np.interp(along, piece[:, 0], piece[:, 1]) - y) / abs(slope)
    assert np.sqrt(np.mean(off**2)) < 0.5
    assert np.all((piece[:, 1] > drawn.top) & (piece[:, 1] < drawn.bottom))


def test_gaps_are_not_bridged() -> None:
    x, y = np.arange(60.0), np.sin(np.arange(60.0))
    y[20:30] = np.nan
    assert len(points(chart(axes(x, y)).paths[0][1])) == 2
    assert chart(axes(x, np.full(60, np.nan))).paths[0][1] == ""


def test_a_shared_scale_holds_all_and_is_one() -> None:
    x = np.linspace(0, 1, 50)
    drawn = [chart(one) for one in shared([axes(x, x), axes(x, -30 * x), axes(x, 0 * x)])]
    assert len({one.y_ticks for one in drawn}) == 1
    assert len({one.zero for one in drawn}) == 1


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=5), st.floats(0, 100))
def test_any_data_have_ticks_within_the_axes(values: list[float], band: float) -> None:
    drawn = chart(Axes("a", "b", (Line("after", np.arange(float(len(values))), np.array(values)),), band))
    assert all(drawn.left <= tick.at <= drawn.right for tick in drawn.x_ticks)
    assert all(drawn.top <= tick.at <= drawn.bottom for tick in drawn.y_ticks)
    texts = [tick.text for tick in drawn.y_ticks]
    assert len(set(texts)) == len(texts)
    if drawn.band is not None:
        assert drawn.top <= drawn.band[0] <= drawn.band[0] + drawn.band[1] <= drawn.bottom + 0.1


@given(st.floats(-0.5, 1.5))
def test_percentages_are_near_and_never_certain(part: float) -> None:
    assert {percent(part), tenths(min(max(part, 0.0), 1.0))}.isdisjoint({"0", "100"})
    if percent(part).isdigit():
        assert abs(float(percent(part)) - 100 * part) <= 0.5 + 1e-9


@given(st.floats(-1e4, 1e4), SIZES)
def test_intervals_are_shown_to_a_twentieth_of_themselves(value: float, half: float) -> None:
    shown, interval = with_interval(value, value - half, value + half)
    low, high = (float(end.replace("−", "-")) for end in interval.split(" to "))
    assert float(shown.replace("−", "-")) == pytest.approx(value, abs=0.0501 * half)
    assert (low, high) == pytest.approx((value - half, value + half), abs=0.0501 * half)


@given(SIZES)
def test_numbers_keep_their_digits(value: float) -> None:
    assert float(number(value)) == pytest.approx(value, rel=0.005)
    assert "e" not in number(value)


def test_angles_are_in_degrees_and_ratios_in_percent() -> None:
    for name in effect_names():
        for key, spec in effect_named(name).parameters.items():
            scale = scale_of(spec.unit, spec.meaning, key)
            assert not scale.unit.startswith("rad")
            assert spec.unit == "1" or scale.unit
    assert scale_of("rad", "")(np.pi) == pytest.approx(180)


def test_every_effect_of_this_package_has_a_name() -> None:
    """Another package's effect is called by its id without underscores; those here by words of their own."""
    for name in effect_names():
        if effect_named(name).__module__.startswith("continuum.effects"):
            assert effect_in_words(name) != name.replace("_", " "), name
    assert len({effect_in_words(name) for name in effect_names()}) == len(effect_names())


@pytest.mark.parametrize("effect", effect_names())
def test_names_say_which_joints(effect: str) -> None:
    assert re.findall(r"\d+", label_in_words(f"{effect}@2")) == ["2"]
    assert re.findall(r"\d+", label_in_words(f"{effect}@1,3", 4)) == ["1", "3"]
    assert label_in_words(effect) == effect_in_words(effect)
    assert "2" in value_in_words(f"{effect}.size[2]")


def test_what_all_sets_have_is_said_once() -> None:
    own, common = sets_in_words([["angle_offset@1", "tip_payload"], ["inertia@2", "angle_offset@1"]])
    assert own == [label_in_words("tip_payload"), label_in_words("inertia@2")]
    assert common == label_in_words("angle_offset@1")
    nested, common = sets_in_words([["tip_payload"], ["tip_payload", "base_tilt"]])
    assert common == ""
    assert all(nested)


@pytest.mark.parametrize("kind", Kind)
def test_the_record_of_verdicts_is_one(kind: Kind) -> None:
    record = track_record(kind)
    if record is not None:
        assert 0 <= record.right <= record.n
        assert 0 <= record.low <= record.right / record.n <= record.high <= 1

"""A record is read as it was written, a printed value is on its side of the goal, and what is no figure is refused."""

import math
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.errors import FileError, InvalidValueError
from tools.benchmarks.record import Figure, Record, Table, plain, read, write

NUMBERS = st.floats(-1e9, 1e9)
GOALS = st.none() | NUMBERS
FIGURES = st.builds(
    Figure, st.text(min_size=1), NUMBERS, st.text(), GOALS, GOALS, rival=st.just(""), rival_value=st.none(),
    interval=st.none() | st.tuples(NUMBERS, NUMBERS), n=st.none() | st.integers(0, 10**6),
)  # fmt: skip
CELLS = st.lists(st.text(), min_size=2, max_size=2).map(tuple)
TABLES = st.builds(Table, CELLS, st.lists(CELLS, max_size=3).map(tuple))
RECORDS = st.builds(
    Record, st.just("one"), st.text(), st.lists(FIGURES, max_size=3).map(tuple),
    st.dictionaries(st.text(), TABLES, max_size=3), st.lists(st.text(), max_size=2).map(tuple), st.text(), st.text(),
)  # fmt: skip


@given(record=RECORDS)
def test_a_record_is_read_as_it_was_written(tmp_path_factory: pytest.TempPathFactory, record: Record) -> None:
    folder = tmp_path_factory.mktemp("records")
    rival = Figure("with a rival", 1.5, rival="other", rival_value=2.0)
    for wanted in (record, replace(record, figures=(*record.figures, rival))):
        write(wanted, folder)
        assert read(folder) == [wanted]


@given(value=NUMBERS, low=GOALS, high=GOALS)
def test_what_is_printed_meets_the_goal_where_the_value_does(
    value: float, low: float | None, high: float | None
) -> None:
    figure = Figure("x", value, at_least=low, at_most=high)
    again = Figure("x", float(figure.printed), at_least=low, at_most=high)
    assert again.is_met is figure.is_met


@given(value=NUMBERS)
def test_numbers_are_printed_to_three_digits_and_whole_ones_whole(value: float) -> None:
    text = plain(value)
    assert "e" not in text
    assert float(text) == pytest.approx(value, rel=5e-3)
    assert plain(round(value)) == str(round(value))


@pytest.mark.parametrize(
    ("value", "low", "high", "met"),
    [
        (1.0, None, None, None), (1.0, 1.0, None, True), (1.0, None, 1.0, True), (1.0, 1.0, 1.0, True),
        (0.9, 1.0, None, False), (1.1, None, 1.0, False), (2.0, 1.0, 3.0, True), (4.0, 1.0, 3.0, False),
    ],
)  # fmt: skip
def test_bounds_belong_to_the_goal(value: float, low: float | None, high: float | None, met: bool | None) -> None:
    assert Figure("x", value, at_least=low, at_most=high).is_met is met


@pytest.mark.parametrize(
    "wrong",
    [
        {"value": math.nan}, {"value": math.inf}, {"at_most": math.nan}, {"interval": (0.0, math.inf)},
        {"what": ""},
        {"rival": "other"}, {"rival_value": 1.0},
    ],
    ids=str,
)  # fmt: skip
def test_what_is_no_figure_is_refused(wrong: dict) -> None:
    with pytest.raises(InvalidValueError):
        Figure(**({"what": "x", "value": 1.0} | wrong))


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"name": "one"}'])
def test_another_file_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "one.json").write_text(text, encoding="utf-8")
    with pytest.raises(FileError, match="is no record"):
        read(tmp_path)

"""The page has each figure once, missed goals first, and what the records of the checkout say; commands are there."""

import importlib.util
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.errors import FileError
from tools.benchmarks.record import Figure, Record, Table, read
from tools.benchmarks.report import MOST, as_text, chosen, make, page, publish, with_tables

ROOT = Path(__file__).resolve().parents[3]
DOCS = ROOT / "docs"
KEPT = read(DOCS / "benchmarks")

COUNTS = st.lists(st.tuples(*[st.integers(0, 30)] * 3), max_size=5)


def records(counts: list[tuple[int, int, int]]) -> list[Record]:
    """For each so many figures that miss their goal, meet it, and have none, in turn of all kinds."""
    found = []
    for number, (missed, met, without) in enumerate(counts):
        kinds = [{"at_most": 0.0}] * missed + [{"at_most": 2.0}] * met + [{}] * without
        figures = [Figure(f"figure {number}.{k}", 1.0, **kind) for k, kind in enumerate(kinds)]
        found.append(Record(f"record-{number}", f"make it-{number}", tuple(figures[::2] + figures[1::2])))
    return found


@given(counts=COUNTS)
def test_each_figure_stands_once_at_most_and_missed_ones_come_first(counts: list[tuple[int, int, int]]) -> None:
    shown = [figure for _, figure in chosen(records(counts))]
    missed, others = sum(count[0] for count in counts), sum(sum(count[1:]) for count in counts)
    assert len({figure.what for figure in shown}) == len(shown) == min(MOST, missed + others)
    order = [(False, True, None).index(figure.is_met) for figure in shown]
    assert order == sorted(order)
    assert order.count(0) == min(MOST, missed)


@given(counts=COUNTS)
def test_no_benchmark_fills_the_page_before_another_has_its_place(counts: list[tuple[int, int, int]]) -> None:
    """Of the figures that miss nothing: where one record has two more than another, the other has no more."""
    given_ = records([(0, met, without) for _, met, without in counts])
    shown = [record.name for record, _ in chosen(given_)]
    for record in given_:
        left = len(record.figures) > shown.count(record.name)
        assert not left or shown.count(record.name) >= max(map(shown.count, shown), default=0) - 1


def lines_of(text: str) -> list[str]:
    return [line for line in text.partition("\n## ")[0].splitlines() if line.startswith("| ")][1:]


def test_the_page_of_the_checkout_is_that_of_its_records() -> None:
    text = (DOCS / "benchmarks.md").read_text(encoding="utf-8")
    assert text == page(KEPT)
    lines = lines_of(text)
    assert 0 < len(lines) <= MOST
    for _, figure in chosen(KEPT):
        assert sum(line.startswith(f"| {figure.what} | ") for line in lines) == 1
    assert all(line.count(" |") == 6 for line in lines)


def test_tables_of_other_pages_are_those_of_the_records() -> None:
    for path in DOCS.glob("*.md"):
        text = path.read_text(encoding="utf-8")
        assert with_tables(text, KEPT, path) == text


@pytest.mark.parametrize("record", KEPT, ids=lambda record: record.name)
def test_records_name_commands_that_are_there_and_each_figure_once(record: Record) -> None:
    if target := re.fullmatch(r"make ([a-z-]+)", record.command):
        makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
        assert re.search(rf"^{target[1]}:", makefile, re.MULTILINE)
    else:
        module = re.fullmatch(r"python3 -m ([\w.]+)", record.command)
        assert module
        assert importlib.util.find_spec(module[1])
    assert (DOCS / "benchmarks" / f"{record.name}.json").is_file()
    assert len({figure.what for figure in record.figures}) == len(record.figures)
    assert all(len(row) == len(one.head) for one in record.tables.values() for row in one.rows)
    assert all(figure.printed in as_text(record) for figure in record.figures)


BEGIN, END = "<!-- from benchmarks/one.json: a table -->", "<!-- end -->"
RECORD = Record("one", "make one", (Figure("x", 1.0),), {"a table": Table(("head",), (("cell",),))})


def test_only_what_stands_between_is_replaced(tmp_path: Path) -> None:
    other = tmp_path / "page.md"
    around = f"# Page\n\n{BEGIN}\n{{}}\n{END}\n\nMore.\n\n<!-- end -->\n"
    for inside in ("", "\nold\n"):
        other.write_text(around.format(inside), encoding="utf-8")
        publish(RECORD, tmp_path)
        assert other.read_text(encoding="utf-8") == around.format("\n| head |\n|---|\n| cell |\n")
    assert (tmp_path / "benchmarks.md").read_text(encoding="utf-8") == page([RECORD])


def test_a_table_that_is_not_there_is_refused(tmp_path: Path) -> None:
    (tmp_path / "page.md").write_text(f"{BEGIN}\n{END}\n", encoding="utf-8")
    with pytest.raises(FileError, match="'a table' of benchmarks/one"):
        make(tmp_path)

"""Generate docs/benchmarks.md and the tables of other pages from the records of the benchmarks.

    python3 -m tools.benchmarks.report

A page shows a table of a record between two lines: ``<!-- from benchmarks/NAME.json: TABLE -->`` and ``<!-- end -->``.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterable, Sequence
from itertools import zip_longest
from pathlib import Path

import jinja2

from continuum.errors import FileError
from continuum.whole_file import write_whole
from tools.benchmarks.record import Figure, Record, read, write
from tools.docs.markdown import table
from tools.one_line import in_one_line

DOCS = Path("docs")
FOLDER = "benchmarks"
PAGE = "benchmarks.md"
MOST = 40
"""Largest number of rows, for a readable table. All figures are in the records."""

_WORDS = {False: "**missed**", True: "met", None: ""}
_ORDER = (False, True, None)
_SHOWN = re.compile(r"(<!-- from benchmarks/([\w-]+)\.json: ([^\n]+) -->\n).*?(<!-- end -->)", re.DOTALL)

type Row = tuple[Record, Figure]


def publish(record: Record, docs: Path = DOCS) -> None:
    """Write a record, and regenerate the pages that show records.

    Raises:
        FileError: a file cannot be written, or a page shows a table that no record contains.
    """
    written = write(record, docs / FOLDER)
    make(docs)
    print(f"written: {written}, {docs / PAGE}")


def make(docs: Path = DOCS) -> None:
    """Generate the pages from all stored records.

    Raises:
        FileError: as `publish`.
    """
    records = read(docs / FOLDER)
    write_whole(docs / PAGE, page(records))
    for path in sorted(docs.glob("*.md")):
        before = path.read_text(encoding="utf-8")
        if (after := with_tables(before, records, path)) != before:
            write_whole(path, after)


def as_text(record: Record) -> str:
    """Return figures and tables of one record as text."""
    lines = (f"{one.what}: {one.printed}" + f" (goal {one.goal})" * bool(one.goal) for one in record.figures)
    tables = (f"{name}\n\n{table(one.head, one.rows)}" for name, one in record.tables.items())
    return "\n\n".join(["\n".join(lines), *tables])


def page(records: Sequence[Record]) -> str:
    """Return the page of all records."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=False,  # noqa: S701  (Markdown, of this checkout's own records)
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
        keep_trailing_newline=True,
    )
    total = sum(len(record.figures) for record in records)
    template = environment.get_template(f"{PAGE}.jinja")
    return template.render(records=records, rows=chosen(records), total=total, words=_WORDS)


def chosen(records: Sequence[Record], most: int = MOST) -> list[Row]:
    """Return the rows of the page: missed goals, then goals that are met, then figures without goals.

    The page contains all missed goals, and the first other figures of each record in turn.
    """
    by_record = [[(record, figure) for figure in record.figures] for record in records]
    missed = [row for rows in by_record for row in rows if row[1].is_met is False]
    others = [[row for row in rows if row[1].is_met is not False] for rows in by_record]
    in_turn = [row for turn in zip_longest(*others) for row in turn if row is not None]
    kept = [*missed, *in_turn][:most]
    ordered = [row for rows in by_record for row in rows if row in kept]
    return sorted(ordered, key=lambda row: _ORDER.index(row[1].is_met))


def with_tables(text: str, records: Iterable[Record], path: Path) -> str:
    """Return a page's text with the current tables of the records.

    Raises:
        FileError: no record contains such a table.
    """
    known = {(record.name, name): one for record in records for name, one in record.tables.items()}

    def shown(match: re.Match[str]) -> str:
        begin, record, name, end = match.groups()
        if (record, name) not in known:
            raise FileError(path, f"shows {name!r} of benchmarks/{record}.json, which is not there")
        one = known[record, name]
        return f"{begin}\n{table(one.head, one.rows)}\n\n{end}"

    return _SHOWN.sub(shown, text)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--docs", type=Path, default=DOCS, help="folder of pages and records; default %(default)s")
    make(parser.parse_args().docs)


if __name__ == "__main__":
    sys.exit(in_one_line(main))

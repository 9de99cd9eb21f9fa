"""Tables and text for a terminal of 80 columns."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

_WIDTH = 80


def print_text(text: str) -> None:
    """Print a paragraph, wrapped at words to the width of the terminal."""
    print(textwrap.fill(text, _WIDTH, break_long_words=False, break_on_hyphens=False))


def print_table(headings: Sequence[str], rows: Iterable[Sequence[str]], title: str | None = None) -> None:
    """Print rows under headings, with the first column left-aligned and figures right-aligned.

    Text is printed literally: brackets, for example around units, are not markup.
    """
    table = Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False)
    for i, heading in enumerate(headings):
        table.add_column(Text(heading), justify="right" if i else "left", vertical="top")
    for row in rows:
        table.add_row(*map(Text, row))
    if title is not None:
        print(f"{title}\n")
    Console().print(table)


def print_pairs(pairs: Iterable[tuple[str, str]]) -> None:
    """Print pairs of name and value, one per line."""
    table = Table(box=None, show_header=False, padding=(0, 3, 0, 0), pad_edge=False)
    table.add_column(no_wrap=True)
    table.add_column()
    for name, value in pairs:
        table.add_row(Text(name, style="bold"), Text(value))
    Console().print(table)

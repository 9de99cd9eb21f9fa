"""Paragraphs and tables of the pages that the tools write."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from pathlib import Path

from continuum.whole_file import write_whole


def paragraph(*parts: str) -> str:
    """Parts that are not empty, as lines of the width that all pages have."""
    return textwrap.fill(" ".join(part for part in parts if part), 120, break_long_words=False, break_on_hyphens=False)


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table; the word that there is none where there are no rows."""
    lines = [f"| {' | '.join(map(str, row))} |" for row in rows]
    if not lines:
        return "None."
    return "\n".join([f"| {' | '.join(head)} |", f"|{'---|' * len(head)}", *lines])


def replace_between(page: Path, begin: str, end: str, text: str) -> None:
    """Put a text between two lines of a page, in the place of what stands there."""
    head, _, rest = page.read_text(encoding="utf-8").partition(begin)
    tail = rest.partition(end)[2]
    write_whole(page, f"{head}{begin}\n\n{text}\n\n{end}{tail}")

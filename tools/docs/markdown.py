"""Paragraphs and tables of the pages that the tools write."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence


def paragraph(*parts: str) -> str:
    """Parts that are not empty, as lines of the width that all pages have."""
    return textwrap.fill(" ".join(part for part in parts if part), 120, break_long_words=False, break_on_hyphens=False)


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table; the word that there is none where there are no rows."""
    lines = [f"| {' | '.join(map(str, row))} |" for row in rows]
    if not lines:
        return "None."
    return "\n".join([f"| {' | '.join(head)} |", f"|{'---|' * len(head)}", *lines])

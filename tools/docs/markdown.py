"""Paragraphs and tables for the pages that the tools generate."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence


def paragraph(*parts: str) -> str:
    """Join the non-empty parts and wrap them to the width of all pages."""
    return textwrap.fill(" ".join(part for part in parts if part), 120, break_long_words=False, break_on_hyphens=False)


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a table; without rows, a statement that there are none."""
    lines = [f"| {' | '.join(map(str, row))} |" for row in rows]
    if not lines:
        return "None."
    return "\n".join([f"| {' | '.join(head)} |", f"|{'---|' * len(head)}", *lines])

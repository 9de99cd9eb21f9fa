"""Result of an exam: its section of the page, and its figures."""

from __future__ import annotations

from typing import NamedTuple

from tools.benchmarks.record import Figure


class Section(NamedTuple):
    """Markdown with its heading, and figures for the record."""

    text: str
    figures: tuple[Figure, ...]

"""A progress bar on the terminal, on standard error; a line for each stage where that is no terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn


@contextmanager
def told() -> Iterator[Callable[[str, float], None]]:
    """A function that shows what is going on, and the part of it that is done, 0 to 1."""
    if not sys.stderr.isatty():
        yield _lines()
        return
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("", total=1.0)
        yield lambda what, part: progress.update(task, description=what, completed=part)


def _lines() -> Callable[[str, float], None]:
    """Tells each stage once, as it begins."""
    told_last = ""

    def tell(what: str, _part: float) -> None:
        nonlocal told_last
        if what != told_last:
            print(f"continuum: {what}", file=sys.stderr, flush=True)
            told_last = what

    return tell

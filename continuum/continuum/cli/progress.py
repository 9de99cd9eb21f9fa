"""A progress bar on the terminal, on standard error; lines where that is no terminal."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, ProgressColumn, Task, TextColumn, TimeElapsedColumn
from rich.table import Column
from rich.text import Text

from continuum.languages import ENGLISH, Translator

_ENOUGH = 0.1
"""Part that has to be over before the time that is left is stated, as of less it says little; and from line to line."""

_BAR = 16  # characters, so that a name has room beside it on 80 columns


@contextmanager
def progress_bar(tr: Translator = ENGLISH) -> Iterator[Callable[[str, float], None]]:
    """A function that shows what is going on, and the part of it that is done, 0 to 1, in a language."""
    if not sys.stderr.isatty():
        yield _lines(tr)
        return
    columns = (
        TextColumn("{task.description}", markup=False, table_column=Column(ratio=1, no_wrap=True)),
        BarColumn(_BAR, table_column=Column(min_width=_BAR)),
        TimeElapsedColumn(table_column=Column(min_width=len("0:00:00"))),
        _Left(tr, Column(min_width=len(_minutes_left(600, tr)))),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True, expand=True) as progress:
        task = progress.add_task("", total=1.0, stated=0.0)

        def tell(what: str, part: float) -> None:
            progress.update(task, description=tr(what), completed=part, stated=progress.tasks[0].elapsed)

        yield tell


def left_in_words(part: float, stated: float, elapsed: float, tr: Translator = ENGLISH) -> str:
    """At least how long it will take yet; empty where that is not known or less than a second.

    Work whose part p is over after t seconds takes t / p in all. A search goes on where an effect helps, and takes
    longer then.

    Args:
        part: of all that is over, 0 to 1.
        stated: when that was stated, since the beginning [s].
        elapsed: since the beginning [s].
        tr: to the language of the output.
    """
    if not _ENOUGH < part <= 1:
        return ""
    left = math.floor(stated / part - elapsed)
    if left < 1:
        return ""
    if left < 60:
        return tr("at least {seconds} s left", seconds=left)
    return _minutes_left(left, tr)


def _minutes_left(seconds: int, tr: Translator) -> str:
    return tr("at least {minutes} min {seconds:02d} s left", minutes=seconds // 60, seconds=seconds % 60)


class _Left(ProgressColumn):
    """The time that is left."""

    def __init__(self, tr: Translator, column: Column) -> None:
        super().__init__(column)
        self._tr = tr

    def render(self, task: Task) -> Text:
        words = left_in_words(task.completed, task.fields["stated"] or 0.0, task.elapsed or 0.0, self._tr)
        return Text(words, style="progress.remaining")


def _lines(tr: Translator) -> Callable[[str, float], None]:
    """Prints a line as a stage begins, and whenever a further tenth of all is over."""
    last, printed, began = "", 0.0, time.monotonic()

    def tell(what: str, part: float) -> None:
        nonlocal last, printed
        if what != last or part >= printed + _ENOUGH:
            elapsed = time.monotonic() - began
            left = left_in_words(part, elapsed, elapsed, tr)
            print(f"continuum: {tr(what)}" + f" ({left})" * bool(left), file=sys.stderr, flush=True)
            last, printed = what, part

    return tell

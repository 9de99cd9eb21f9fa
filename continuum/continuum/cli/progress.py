"""A progress bar on the terminal, on standard error; lines where that is no terminal."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, ProgressColumn, Task, TextColumn, TimeElapsedColumn
from rich.table import Column
from rich.text import Text

from continuum.languages import ENGLISH, Translator

type Steps = Sequence[tuple[float, float]]
"""Part of all that was over, 0 to 1, and the time since the beginning [s] when that was stated, in turn."""

_LINE = 0.1
"""Part from line to line of the same step."""

_ENOUGH, _ALIKE = 0.2, 1.5
"""Part of which less says little, and ratio of two estimates of the whole time from which they disagree."""

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
        _Left(tr, Column(min_width=len(_minutes(59, tr)))),
    )
    steps = list[tuple[float, float]]()
    with Progress(*columns, console=Console(stderr=True), transient=True, expand=True) as progress:
        task = progress.add_task("", total=1.0, steps=steps)

        def tell(what: str, part: float) -> None:
            steps.append((part, progress.tasks[0].elapsed or 0.0))
            progress.update(task, description=tr(what), completed=part)

        yield tell


def left_in_words(steps: Steps, elapsed: float, tr: Translator = ENGLISH) -> str:
    """About how long it will take yet; empty if that is not known, or if all is nearly over.

    Work whose part p is over after t seconds takes t / p in all. A search takes longer where an effect helps, so this
    is stated only while all that was stated since half of p gives nearly the same time.

    Args:
        steps: what was stated.
        elapsed: time since the beginning [s].
        tr: to the language of the output.
    """
    part, stated = steps[-1] if steps else (0.0, 0.0)
    if not _ENOUGH <= part <= 1:
        return ""
    measured = [(p, t) for p, t in steps if 0 < p <= part and p >= 0.5 * part]
    whole = [t / p for p, t in measured]
    if min(p for p, _ in measured) > 0.75 * part or not 0 < max(whole) <= _ALIKE * min(whole):
        return ""
    left = stated / part - elapsed
    if left < 1:
        return ""
    if left <= 50:
        return tr("about {seconds} s left", seconds=10 * math.ceil(left / 10))
    return _minutes(max(1, round(left / 60)), tr)


def _minutes(minutes: int, tr: Translator) -> str:
    return tr("about {minutes} min left", minutes=minutes)


class _Left(ProgressColumn):
    """The time that is left."""

    def __init__(self, tr: Translator, column: Column) -> None:
        super().__init__(column)
        self._tr = tr

    def render(self, task: Task) -> Text:
        return Text(left_in_words(task.fields["steps"], task.elapsed or 0.0, self._tr), style="progress.remaining")


def _lines(tr: Translator) -> Callable[[str, float], None]:
    """Prints a line as a stage begins, and whenever a further tenth of all is over."""
    last, printed, began = "", 0.0, time.monotonic()
    steps = list[tuple[float, float]]()

    def tell(what: str, part: float) -> None:
        nonlocal last, printed
        elapsed = time.monotonic() - began
        steps.append((part, elapsed))
        if what != last or part >= printed + _LINE:
            left = left_in_words(steps, elapsed, tr)
            print(f"continuum: {tr(what)}" + f" ({left})" * bool(left), file=sys.stderr, flush=True)
            last, printed = what, part

    return tell

"""Whoever asks for a fit is given a known one, so that the order of a search and what it keeps can be told."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from discovery_laws import trial

from continuum.discovery.candidate import Extension
from continuum.discovery.evidence import unexplained
from continuum.discovery.trial import Trial
from continuum.discovery.workers import Task

EFFECTS = ("tip_payload", "base_tilt", "quadratic_drag")


class Fits:
    """Gives every extension the share of windows that it leaves unexplained; the cost goes with it.

    Attributes:
        asked: every task, in order.
    """

    def __init__(self, shares: dict[tuple[str, ...], float], better: dict[tuple[str, ...], float] | None = None):
        self._shares, self._better, self.asked = shares, better or {}, list[Task]()

    def __call__(self, tasks: Sequence[Task]) -> Iterator[Trial]:
        for task in tasks:
            self.asked.append(task)
            yield self.fitted(task)

    def fitted(self, task: Task) -> Trial:
        names = tuple(addition.effect for addition in task.extension)
        known = {frozenset(key): share for key, share in self._shares.items()}
        share = known[frozenset(names)] if frozenset(names) in known else known[frozenset(names[:-1])]
        is_from_another = task.near is not None and len(task.near.extension) > len(task.extension)
        if is_from_another and names in self._better:
            share = self._better[names]
        if task.near is not None and task.near.extension == task.extension:
            share = min(share, unexplained(task.near))  # no fit ends worse than it began
        made = trial(*names, bad=share, seed=len(names))
        return replace(made, extension=task.extension, cost=made.misfit / 2)

    def times(self, *names: str) -> int:
        return sum(tuple(a.effect for a in task.extension) == names for task in self.asked)


def effects_of(extension: Extension) -> list[str]:
    return [addition.effect for addition in extension]

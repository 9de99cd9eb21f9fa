"""The result of a search: all sets that were fitted, each with its state and its fit."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from continuum.discovery.candidate import Candidate
from continuum.discovery.fit_result import Fitted
from continuum.discovery.output_error import OutputError
from continuum.discovery.problem import Problem
from continuum.discovery.search import Found
from continuum.discovery.zeros_by_hand import agreement


@dataclass(frozen=True)
class Examined:
    """A set of effects with the results of search and fit.

    Attributes:
        found: set with the linearised state about it.
        fit: fit by open-loop simulations.
    """

    found: Found
    fit: Fitted

    @cached_property
    def candidate(self) -> Candidate:
        """The set as the decision needs it."""
        fit, zeros = self.fit, agreement(self.found.lin.problem, self.fit)
        effects = tuple(h.key for h in self.found.chosen)
        return Candidate(
            effects, fit.errors, fit.observations, fit.occam, fit.of_effects, fit.agreement, fit.departure, zeros
        )  # fmt: skip


@dataclass(frozen=True)
class Examination:
    """All that a decision rests on.

    Attributes:
        problem: what stays fixed during the search.
        judge: output-error fits of the recordings.
        baseline: the refitted model alone.
        others: sets of effects.
        log: log of the search, for developers.
    """

    problem: Problem
    judge: OutputError
    baseline: Examined
    others: tuple[Examined, ...]
    log: tuple[str, ...]

    @cached_property
    def by_key(self) -> dict[frozenset[object], Examined]:
        """All sets, by their effects and places."""
        return {one.found.key: one for one in (self.baseline, *self.others)}

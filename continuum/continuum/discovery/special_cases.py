"""Which of two effects it is, where one differs from run to run and the other is the same thing in all of them.

A base that may hang otherwise in every run also explains one that hangs askew once and for all, for the same price
(`price_of_own`): there it is no rival, but that one by another name.
"""

from __future__ import annotations

from collections.abc import Sequence

from continuum.discovery.trial import Trial
from continuum.dynamics.effect_lookup import effect_named


def without_special_cases(trials: Sequence[Trial]) -> list[Trial]:
    """Trials of one round, less those whose values are alike in all runs and stand there under that one's name."""
    there = {trial.extension[-1].effect for trial in trials}
    return [t for t in trials if not (t.one_for_all.unknowns and _alike(t) in there)]


def _alike(trial: Trial) -> str:
    return effect_named(trial.extension[-1].effect).alike_in_all_runs

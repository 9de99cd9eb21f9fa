"""Which of two effects it is, where one differs from run to run and the other is the same thing in all of them.

A base that may hang otherwise in every run also explains one that hangs askew once and for all, for the same price
(`price_of_own`): where nothing tells its values apart and the other explains as much, it is no rival, but that one by
another name. In one run alone the two are the same.
"""

from __future__ import annotations

from collections.abc import Sequence

from scipy.stats import chi2

from continuum.discovery.evidence import gain
from continuum.discovery.trial import Trial
from continuum.dynamics.effect_lookup import effect_named

_CHANCE = 0.01  # that values which are the same come out as far apart


def without_special_cases(trials: Sequence[Trial]) -> list[Trial]:
    """Trials of one round, less those that stand there under another one's name as well."""
    there = {trial.extension[-1].effect: trial for trial in trials}
    return [trial for trial in trials if not _is_one_of(trial, there.get(_simpler(trial.extension[-1].effect)))]


def worth_trying(effects: Sequence[str], n_recordings: int) -> list[str]:
    """Of the names of effects those that are no other one of them by another name.

    One that the model has already is not among them: its value stays, and what is added to it may be what is asked for.
    """
    return [name for name in effects if n_recordings > 1 or _simpler(name) not in effects]


def _is_one_of(trial: Trial, simpler: Trial | None) -> bool:
    """Whether its last effect is the same in all runs, and the simpler one explains as much."""
    saved = trial.saved.get(trial.extension[-1].effect)
    if simpler is None or saved is None or chi2.sf(saved.misfit, saved.unknowns) < _CHANCE:
        return False
    return not gain(trial, simpler).is_distinct


def _simpler(effect: str) -> str:
    return effect_named(effect).alike_in_all_runs

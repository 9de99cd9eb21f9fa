"""What trials say against each other: how many windows stay unexplained, and by how much one trial beats another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import binom, chi2

from continuum.arrays import Array
from continuum.discovery.information import information_gain
from continuum.discovery.trial import Trial

_UNEXPLAINED = 2.0  # misfit of a window beside that of noise, ...
_RARE = 0.005  # ... or what noise seldom is, where a window holds few errors
_BY_CHANCE = 0.02  # share of windows that stay so of a right model: sticking joints now and then hold one
_LOUD = 1.4  # misfit of half of the windows beside that of noise; right models have 0.7 to 1.0
_CHANCE = 0.01  # probability of as many by chance, below which something is missing
_CHANCE_OF_CAUSE = 0.1  # the same where a cause is to be named: the wrong one is worse than none
_SIGNIFICANT = 15.0  # log-likelihood
_SPREAD, _SURE = 1.5, 2.0  # deviations
_LOST, _FEWEST = 3.0, 3  # times what a run loses, it gains more; runs of which each tells it
_STRETCH = 4  # windows, over which errors may hang together

DISTINCT = 8.0
"""Log-likelihood by which one of two hypotheses must lead to be told from the other."""


@dataclass(frozen=True)
class Gain:
    """What one trial gains over another on windows that neither was fitted to.

    Attributes:
        log_likelihood: sum over all windows.
        deviation: standard deviation of that sum, from stretches of windows.
        rest: the same sum without the run that gains most; of a single run, without its best quarter.
        least: the sum of the run that tells least, less three times what its stretches lose that lose; of a single
            run, of its worst quarter. Less than three runs tell nothing by it.
        information: what the fit gains on all windows, less the price of its unknowns.
    """

    log_likelihood: float
    deviation: float
    rest: float
    least: float
    information: float

    @property
    def is_significant(self) -> bool:
        """Whether it is more than chance gives with some forty hypotheses tried, worth it, and not one run's doing.

        What acts in one short phase of every run has few stretches to show in: enough where each run tells it alone.
        """
        is_no_chance = self._is_beyond(_SPREAD) or self.least > DISTINCT
        return self.rest > _SIGNIFICANT and is_no_chance and self.information > 0

    @property
    def is_distinct(self) -> bool:
        """Whether one of two hypotheses is told from the other by it."""
        return self.rest > DISTINCT and self._is_beyond(_SPREAD)

    @property
    def is_sure(self) -> bool:
        """Whether one of two hypotheses is told from the other by it where either would do by itself."""
        return self.rest > DISTINCT and self._is_beyond(_SURE)

    def _is_beyond(self, deviations: float) -> bool:
        """Whether more than a few stretches make it."""
        return self.log_likelihood > deviations * self.deviation


def unexplained(trial: Trial) -> float:
    """Share of windows that noise does not explain, 0 to 1."""
    return float(np.mean(np.concatenate(_unexplained_windows(trial))))


def beyond_noise(trial: Trial) -> float:
    """Log-likelihood that is left to explain."""
    return max(trial.misfit - float(sum(run.sum() for run in trial.sizes)), 0.0) / 2


def is_adequate(trial: Trial) -> bool:
    """Whether what is left is noise: not loud, and by chance as many windows unexplained, in all runs and in each.

    A motion that none of the other runs has may be the only one to show what is missing.
    """
    if _is_loud(trial):
        return False
    runs = _unexplained_windows(trial)
    return _chance(np.concatenate(runs)) > _CHANCE and min(map(_chance, runs)) > _CHANCE / len(runs)


def explains_all(trial: Trial) -> bool:
    """Whether its effects explain so much that they may be named."""
    return not _is_loud(trial) and _chance(np.concatenate(_unexplained_windows(trial))) > _CHANCE_OF_CAUSE


def _is_loud(trial: Trial) -> bool:
    """Whether most windows hold a little more than noise, each too little to be unexplained by itself."""
    return bool(np.median(trial.relative) > _LOUD)


def _unexplained_windows(trial: Trial) -> list[Array]:
    """Whether noise does not explain it, of every window of each run."""
    return [
        misfit / size > np.maximum(_UNEXPLAINED, chi2.isf(_RARE, size) / size)
        for misfit, size in zip(trial.held_out, trial.sizes, strict=True)
    ]


def _chance(windows: Array) -> float:
    """Probability that a right model leaves as many of these windows unexplained."""
    return float(binom.sf(np.sum(windows) - 1, windows.size, _BY_CHANCE))


def gain(trial: Trial, over: Trial) -> Gain:
    """Of one trial over another, both of the same data."""
    each = [_stretched((b - a) / 2) for a, b in zip(trial.held_out, over.held_out, strict=True)]
    stretches = np.concatenate(each)
    total = float(stretches.sum())
    runs = [float(run.sum()) for run in each]
    told = [float(run.sum() + _LOST * np.minimum(run, 0.0).sum()) for run in each]
    least = min(told) if len(told) >= _FEWEST else -np.inf
    deviation = float(np.std(stretches) * np.sqrt(stretches.size))
    return Gain(total, deviation, total - max(runs), least, information_gain(trial, over))


def _stretched(run: Array) -> Array:
    return np.array([run[i : i + _STRETCH].sum() for i in range(0, run.size, _STRETCH)])

"""Choice between commanded and measured torques of the double pendulum, by the errors of the same sets with each.

Fits of one set end at different optima, because friction makes the cost rough. Each set is therefore fitted to each
choice from two unbiased starts, with inputs held from row to row and linear between rows, until the fit settles.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import log

import numpy as np
from scipy.special import stdtrit

from continuum.arrays import Array
from continuum.discovery.candidate import Key, log_errors, mean_error
from continuum.discovery.fit_result import Fitted
from continuum.discovery.output_error import OutputError
from continuum.discovery.refit import refitted
from continuum.discovery.search import Found
from tools.benchmarks.exams.pendulum_runs import nominal, recordings


@dataclass(frozen=True)
class TorqueFit:
    """A set fitted with one choice of torques, from one start.

    Attributes:
        label: label of the set.
        held: whether inputs are held from row to row.
        errors: open-loop error of each segment, (segments,) [rad].
        independent: number of independent residuals.
    """

    label: str
    held: bool
    errors: Array
    independent: float

    @property
    def error(self) -> float:
        """Geometric mean over the segments [rad]."""
        return float(mean_error(self.errors))


@dataclass(frozen=True)
class TorqueChoice:
    """All fits with one torque of each joint.

    Attributes:
        torques: ``measured`` or ``commanded``, one for each joint.
        fits: fits of every set.
        seconds: processor time [s].
    """

    torques: tuple[str, ...]
    fits: tuple[TorqueFit, ...]
    seconds: float

    @property
    def best(self) -> TorqueFit:
        """Return the fit with the smallest error."""
        return min(self.fits, key=lambda one: one.error)

    @property
    def by_start(self) -> float:
        """Return the logarithm of the ratio of errors between the worse and the better start of the best fit."""
        same = [one.error for one in self.fits if (one.label, one.held) == (self.best.label, self.best.held)]
        return log(max(same) / self.best.error)


@dataclass(frozen=True)
class Difference:
    """Difference in likelihood between two choices.

    Attributes:
        log_likelihood: independent residuals times the difference of the logarithms of the errors.
        low, high: its 95 % interval, by a paired t test over segments.
        by_start: the same for the starts of one fit, of the choice where these matter more.
    """

    log_likelihood: float
    low: float
    high: float
    by_start: float

    @property
    def is_chance(self) -> bool:
        """Whether segments, or the starts of one fit, differ by the same amount."""
        return self.low <= 0 or self.log_likelihood <= self.by_start


def tried(torques: Sequence[str], keys: Sequence[Key]) -> TorqueChoice:
    """Fit sets of effects to the given runs with these torques."""
    began = time.process_time()
    start, judge = refitted(recordings(torques=torques), nominal())
    lin, fits = start.found.lin, list[TorqueFit]()
    for key in keys:
        found = Found(lin, tuple(next(h for h in lin.library.hypotheses if h.key == one) for one in key))
        for held in (True, False):
            runs = tuple(run.with_held(held) for run in judge.problem.runs)
            by = judge.around(replace(judge.problem, runs=runs))
            for near in ([], [start.fit]):
                fit = _settled(by, found, near)
                fits.append(TorqueFit(found.label, held, fit.errors, fit.observations))
    return TorqueChoice(tuple(torques), tuple(fits), time.process_time() - began)


def _settled(judge: OutputError, found: Found, near: Sequence[Fitted]) -> Fitted:
    """Continue a fit while its error decreases."""
    fit = judge.fit(found, near)
    while not fit.settled and (further := judge.further(found, fit)).error < fit.error:
        fit = further
    return fit


def difference(one: TorqueChoice, other: TorqueChoice) -> Difference:
    """Return the difference in likelihood between the best fits of two choices."""
    count = min(one.best.independent, other.best.independent)
    farther, n = log_errors(one.best.errors) - log_errors(other.best.errors), len(one.best.errors)
    half = float(stdtrit(n - 1, 0.975) * np.std(farther, ddof=1) / np.sqrt(n))
    middle = float(np.mean(farther))
    by_start = count * max(one.by_start, other.by_start)
    return Difference(count * middle, count * (middle - half), count * (middle + half), by_start)

"""The decision: what candidates' evidence, missing torque and open-loop simulations allow to be said.

Terms. A candidate *explains* the data where what is missing is no more than any model's, and no torque of free form is
more probable than none. Its *closed share* is the part of the distance between the baseline's open-loop error and the
sensors' noise that it closes on the recordings.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from math import exp, log

import numpy as np
from scipy.stats import t as student

from continuum.arrays import Array
from continuum.discovery.candidate import Candidate, Key

PRICE = 6.0
"""Prior log-odds against one more effect: e^6 = 400 to 1 against any given one of some sixty."""
ODDS = log(19.0)
"""Log-odds from which one of two hypotheses is excluded: 95 %."""
MODEL_ERROR = 0.04
"""Part of what a set of effects explains by which evidence errs: columns are linearised, and friction's curve and a
cable's geometry are right to a few percent."""
NEGLIGIBLE = 0.0125
"""Missing torque that no model of an arm does without, as a part of the torque that moves it."""
LEAST_SHARE = 0.25
"""Least closed share of a cause: what closes less does not make the simulation another one."""
SECOND_SHARE = 0.05
"""Least share that a second effect closes of its own: what closes less does not change a simulation's use."""
FREE_PART = 0.1
"""Part of what a cause explains that a torque of free form may find besides, for the cause to be named alone."""


class Kind(Enum):
    """Kinds of verdicts."""

    ADEQUATE = "adequate"
    CAUSE = "cause"
    AMBIGUOUS = "ambiguous"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Verdict:
    """What is said.

    Attributes:
        kind: of the verdict.
        sets: of effects that the data leave possible, the most probable first; empty where unknown.
        probabilities: of these among each other.
        complete: whether nothing that matters stays unknown.
        helps: the set that helps most where the cause is unknown; empty where none does.
    """

    kind: Kind
    sets: tuple[Key, ...]
    probabilities: tuple[float, ...]
    complete: bool
    helps: Key = ()


def decide(baseline: Candidate, others: Sequence[Candidate], torque: float, floor: float, tolerance: float) -> Verdict:
    """One verdict from all candidates.

    Args:
        baseline: the refitted model alone.
        others: sets of effects, each at its own optimum.
        torque: that moves the arm, root mean square [N m].
        floor: of an open-loop error, by the sensors' noise [rad].
        tolerance: open-loop error that a user accepts [rad].
    """

    def score(one: Candidate) -> float:
        return one.log_evidence - baseline.log_evidence - PRICE * len(one.effects)

    def explains(one: Candidate) -> bool:
        return one.sigma <= NEGLIGIBLE * torque and one.free_form < PRICE

    def margin(one: Candidate) -> float:
        return max(ODDS, MODEL_ERROR * max(one.log_evidence - baseline.log_evidence, 0.0))

    def without_needless(best: Candidate, among: Sequence[Candidate]) -> Candidate:
        # a further effect has to be worth more than what evidence errs by
        for part in among:
            if is_part(part, best) and not adds(baseline, part, best, margin(best), floor):
                best = part
        return best

    most_probable = max(others, key=score, default=baseline)
    # what a part of a set simulates better than the whole, the whole explains by smoothing only
    others = [one for one in others if not any(is_part(two, one) and nearer(one, two) for two in others)]
    # and what closes little is no cause, however probable; several effects must surely close more
    others = [one for one in others if closed(baseline, one, floor)[len(one.effects) > 1] > LEAST_SHARE]
    ranked = sorted([baseline, *others], key=score, reverse=True)
    best = without_needless(ranked[0], ranked)
    sets = [one for one in ranked if score(one) > score(best) - margin(best) and not is_part(best, one)]
    complete = any(explains(one) for one in sets)
    if not complete:  # nothing explains all: what explains most, as open-loop runs confirm it
        most = [one for one in ranked if one is not baseline and explains_most(baseline, one, floor)]
        best = max(most, key=lambda one: closed(baseline, one, floor)[0], default=baseline)
        best = without_needless(best, ranked)
        sets = (
            [one for one in most if not nearer(one, best) and not is_part(best, one)]
            if any(one is best for one in most)
            else []
        )
    if not sets:
        adequate = baseline.completed and float(np.sqrt(np.mean(baseline.errors**2))) < tolerance
        if adequate:
            return Verdict(Kind.ADEQUATE, ((),), (1.0,), False)
        helps = most_probable.effects if score(most_probable) > ODDS else ()
        return Verdict(Kind.UNKNOWN, (), (), False, helps)
    sets.sort(key=lambda one: (one is not best, -score(one)))
    weights = np.array([exp(max(score(one) - score(best), -30.0) / max(margin(best) / ODDS, 1.0)) for one in sets])
    probabilities = tuple(float(w) for w in weights / weights.sum())
    kind = Kind.AMBIGUOUS if len(sets) > 1 else Kind.ADEQUATE if best is baseline else Kind.CAUSE
    return Verdict(kind, tuple(one.effects for one in sets), probabilities, complete)


def explains_most(baseline: Candidate, one: Candidate, floor: float) -> bool:
    """Whether a set closes a clear share, and a torque of free form finds little besides."""
    gained = one.log_evidence - baseline.log_evidence
    return closed(baseline, one, floor)[1] > LEAST_SHARE and one.free_form < FREE_PART * gained


def is_part(one: Candidate, other: Candidate) -> bool:
    """Whether a set is a part of another."""
    return set(one.effects) < set(other.effects)


def adds(baseline: Candidate, part: Candidate, whole: Candidate, margin: float, floor: float) -> bool:
    """Whether a set's further effect is there: more probable by a margin, and open-loop runs come nearer by it."""
    gained = whole.log_evidence - part.log_evidence - PRICE * (len(whole.effects) - len(part.effects))
    if part is baseline:
        return gained > ODDS
    distance = float(np.mean(baseline.errors)) - floor
    closer = _least(part.errors - whole.errors)
    return gained > margin and closer > SECOND_SHARE * max(distance, 0.0)


def nearer(one: Candidate, other: Candidate) -> bool:
    """Whether open-loop errors fall from one to the other, at 95 % by a one-sided t test over runs."""
    return _least(one.errors - other.errors) > 0


def closed(baseline: Candidate, one: Candidate, floor: float) -> tuple[float, float, float]:
    """Closed share with its 95 % interval by the jackknife over runs; 0 where there is no distance to close.

    A simulation that fails counts as one that is off by twice the baseline's error.
    """
    gained = np.where(np.isfinite(one.errors), baseline.errors - one.errors, -baseline.errors)
    distance, n = baseline.errors - floor, len(gained)
    whole = float(np.sum(distance))
    if whole <= 0:
        return 0.0, 0.0, 0.0
    share = float(np.sum(gained)) / whole
    if n == 1:
        return share, -np.inf, np.inf
    without = (np.sum(gained) - gained) / np.maximum(whole - distance, 1e-3 * whole)
    half = float(student.ppf(0.975, n - 1)) * float(np.sqrt((n - 1) / n * np.sum((without - without.mean()) ** 2)))
    return share, share - half, share + half


def _least(gained: Array) -> float:
    """Lower end of a one-sided 95 % interval of the mean over runs."""
    gained = np.where(np.isfinite(gained), gained, -np.inf)
    n = len(gained)
    if n == 1 or not np.all(np.isfinite(gained)):
        return -np.inf
    return float(np.mean(gained) - student.ppf(0.95, n - 1) * np.std(gained, ddof=1) / np.sqrt(n))

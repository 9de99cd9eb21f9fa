"""The decision: which verdict the open-loop errors of segments, each predicted from the others, support.

Terms. The *distance* is the baseline's open-loop error minus the noise. The *closed share* of a set of effects is the
fraction of the distance that it closes. One set is *farther* than another if the logarithm of its error is higher, by a
t test over the segments: all segments count alike, however large their motion, and one that diverges does not dominate.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from math import exp, log, sqrt

import numpy as np
from scipy.special import ndtri, stdtrit

from continuum.arrays import Array
from continuum.discovery.candidate import Candidate, Key, log_errors

PRICE = 6.0
"""Prior log-odds against one more effect: e^6 = 400 to 1 against any given one of some sixty at a few places."""
CHANCE = 0.05
"""Significance level of the tests."""
LEAST_SHARE = 0.5
"""Least closed share of a cause: a cause explains most of what the simulation gets wrong."""
ALIKE = 0.05
"""Fraction of the best set's gain that another may lack and still count as no worse: friction's curve and a cable's
geometry are right to a few percent, and a fit ends as close to its optimum."""


class Kind(Enum):
    """Kinds of verdicts."""

    ADEQUATE = "adequate"
    CAUSE = "cause"
    AMBIGUOUS = "ambiguous"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Verdict:
    """The verdict of a diagnosis.

    Attributes:
        kind: kind of the verdict.
        sets: sets of effects that the data leave possible, the least error first, of ties the more usual values first;
            empty if unknown.
        relative_fits: weights of these by their simulation errors, 1 in total; not probabilities.
        complete: whether nothing that matters stays unexplained.
        steady: whether the segments agree about the sizes of the effects of at least one set.
        helps: if the cause is unknown, the set that helps most; empty if none does.
    """

    kind: Kind
    sets: tuple[Key, ...]
    relative_fits: tuple[float, ...]
    complete: bool
    steady: bool = True
    helps: Key = ()


def decide(
    baseline: Candidate,
    others: Sequence[Candidate],
    floor: float,
    tolerance: float,
    whole: float,
    is_asked: bool = False,
) -> Verdict:
    """Return the verdict on all candidates.

    Recordings that are simulated within the tolerance need no cause if the baseline's error is no more than sensor
    noise and chance give, or if a user set that tolerance.

    Args:
        baseline: the refitted model alone.
        others: sets of effects.
        floor: open-loop error from the sensors' noise alone [rad].
        tolerance: error that a user accepts [rad].
        whole: error of the baseline's simulations of whole recordings [rad].
        is_asked: whether a user set the tolerance.
    """
    noise = noise_in_segments([baseline, *others], floor)
    others = [one for one in others if one.completed and one.zeros > CHANCE]
    others.sort(key=lambda one: (log_error(one), str(one.effects)))
    lowest = log_error(others[0]) if others else np.inf
    alike = ALIKE * max(log_error(baseline) - lowest, 0.0)

    probable = [one for one in others if is_probable(one, baseline) and not is_needless(one, others, alike)]
    possible = [one for one in probable if closed(baseline, one, noise)[1] > LEAST_SHARE]
    if whole < tolerance and (not possible or is_asked or baseline.error <= noise_limit(floor, baseline.observations)):
        return Verdict(Kind.ADEQUATE, ((),), (1.0,), not probable)
    if not possible:
        if baseline.error < tolerance and not probable:
            return Verdict(Kind.ADEQUATE, ((),), (1.0,), True)
        return Verdict(Kind.UNKNOWN, (), (), False, helps=probable[0].effects if probable else ())
    best = possible[0]
    sets = [one for one in probable if one is best or not is_farther(one, best, alike)]
    farther = {id(one): max(log_error(one) - log_error(best), 0.0) / max(alike, 1e-9) for one in sets}
    sets.sort(key=lambda one: (round(farther[id(one)], 1), one.departure))  # ties: the more usual first
    weights = np.array([exp(-farther[id(one)]) for one in sets])
    relative_fits = tuple(float(w) for w in weights / weights.sum())
    best = sets[0]
    steady = any(one.agreement > CHANCE for one in sets)
    complete = best.error < (1 + ALIKE) * floor and steady
    kind = Kind.AMBIGUOUS if len(sets) > 1 else Kind.CAUSE
    return Verdict(kind, tuple(one.effects for one in sets), relative_fits, complete, steady)


def is_probable(one: Candidate, part: Candidate) -> bool:
    """Whether a set gains more over a part of it than its further effects cost and chance gives."""
    gain, effects = log_error(part) - log_error(one), len(one.effects) - len(part.effects)
    return is_worth(gain, one.observations, effects, one.occam - part.occam)


def is_needless(one: Candidate, others: Sequence[Candidate], alike: float) -> bool:
    """Whether a part of a set simulates as well: fewer of its effects, or its effect at fewer joints."""
    parts = [part for part in others if set(part.effects) < set(one.effects) or part.values < one.values]
    return any(not is_farther(part, one, alike) or not is_probable(one, part) for part in parts)


def noise_limit(floor: float, observations: float, floor_error: float = 0.0) -> float:
    """Return the error up to which a one-sided test finds nothing but noise in the residuals [rad].

    The standard deviation of n normal residuals has a relative standard deviation of 1 / sqrt(2 n). That of a floor
    estimated from the same recordings is ``floor_error``.
    """
    if observations <= 0:
        return floor
    return floor * (1 + float(ndtri(1 - CHANCE)) * sqrt(1 / (2 * observations) + floor_error**2))


def is_worth(gain: float, observations: float, effects: int = 1, occam: float = 0.0) -> bool:
    """Whether a fall of the log error is more than effects and their per-run values cost and chance gives.

    Times the number of independent residuals, of unknown variance, it is the gain in log-likelihood.
    """
    return gain * observations > price(effects, occam)


def price(effects: int = 1, occam: float = 0.0) -> float:
    """Return what effects and their per-run values cost and chance gives [log-likelihood]."""
    return PRICE * effects + occam - log(CHANCE)


def noise_in_segments(candidates: Sequence[Candidate], floor: float) -> Array:
    """Return the sensors' noise in each segment, (segments,) [rad]: the best set's errors, scaled to the floor.

    All sets face the same noise; paired comparisons show their differences.
    """
    best = min((one for one in candidates if one.completed), key=lambda one: one.error, default=None)
    if best is None:
        return np.full(len(candidates[0].errors), floor)
    return best.errors * min(1.0, floor / best.error)


def log_error(one: Candidate) -> float:
    """Return the mean logarithm of the errors; infinite where a simulation failed."""
    return log(one.error) if one.completed else np.inf


def is_farther(one: Candidate, other: Candidate, by: float) -> bool:
    """Whether the log error of one set exceeds the other's by more than ``by``, by a one-sided t test over segments."""
    if not (one.completed and other.completed):
        return other.completed
    return is_farther_by(log_errors(one.errors) - log_errors(other.errors), by)


def is_farther_by(excess: Array, by: float) -> bool:
    """Apply the same test to the differences of log errors, (segments,)."""
    n = len(excess)
    if n == 1:
        return False
    half = float(stdtrit(n - 1, 1 - CHANCE)) * np.std(excess, ddof=1) / np.sqrt(n)
    return bool(np.mean(excess) - half > by)


def closed(baseline: Candidate, one: Candidate, noise: Array) -> tuple[float, float, float]:
    """Return the closed share with its 95 % interval by the jackknife over segments; 0 if there is no distance.

    A simulation that fails counts as one with twice the baseline's error.
    """
    share, low, high = closed_share(baseline.errors, one.errors, noise)
    return float(share), float(low), float(high)


def closed_share(before: Array, after: Array, noise: Array) -> tuple[Array, Array, Array]:
    """Return the same for arrays of errors [rad], with the segments along the last axis."""
    gained = np.where(np.isfinite(after), before - after, -before)
    distance, n = before - noise, gained.shape[-1]
    whole, gain = np.sum(distance, axis=-1, keepdims=True), np.sum(gained, axis=-1, keepdims=True)
    is_any = whole > 0
    safe = np.where(is_any, whole, 1.0)
    share = np.where(is_any, gain / safe, 0.0)[..., 0]
    if n == 1:
        half = np.where(is_any[..., 0], np.inf, 0.0)
    else:
        without = (gain - gained) / np.maximum(safe - distance, 1e-3 * safe)
        scatter = np.sum((without - np.mean(without, axis=-1, keepdims=True)) ** 2, axis=-1)
        half = np.where(is_any[..., 0], float(stdtrit(n - 1, 0.975)) * np.sqrt((n - 1) / n * scatter), 0.0)
    return share, share - half, share + half

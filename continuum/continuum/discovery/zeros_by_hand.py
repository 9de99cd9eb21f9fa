"""Zeros of sensors that were set by hand before a recording, compared with those of a set of effects."""

from __future__ import annotations

from collections.abc import Iterable

from scipy.special import ndtr

from continuum.discovery.fit_result import Fitted
from continuum.discovery.problem import Problem, ValueKey
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.parameters import Parameter

WIDENING = 2.0
"""Factor on a fitted value's standard deviation: on the benchmark's arms, 95 % intervals contain the truth in 65 of 100
cases, as expected if standard deviations are too small by a factor of 2."""


def is_zero(spec: Parameter) -> bool:
    """Whether a parameter is a sensor's zero, which a protractor can measure."""
    return spec.per_recording and spec.by_hand is not None


def zeros_in(fit: Fitted, run: int) -> list[tuple[float, float, float]]:
    """Return the zeros of a set in a recording: value, standard deviation, and that of a protractor [rad].

    A zero without a value in the set is left out: it agrees with a zero that was set by hand.
    """
    values = dict[ValueKey, float]()
    variances = dict[ValueKey, float]()
    common = zip(fit.unknowns.common, fit.values.common, fit.sd, strict=True)
    per_run = zip(fit.unknowns.per_run[run], fit.values.per_run[run], fit.per_run_sd[run], strict=True)
    for one, value, sd in (*common, *per_run):
        for key, factor in one.places.items():
            if key[0] and is_zero(effect_named(key[0]).parameters[key[1]]):
                values[key] = values.get(key, 0.0) + factor * float(value)
                variances[key] = variances.get(key, 0.0) + (factor * float(sd)) ** 2
    by_hand = {key: effect_named(key[0]).parameters[key[1]].by_hand for key in values}
    return [(values[key], variances[key] ** 0.5, found.sd) for key, found in by_hand.items() if found is not None]


def probability(zeros: Iterable[tuple[float, float, float]]) -> float:
    """Return the p-value of the largest departure of zeros set by hand, with Bonferroni correction; 1 without zeros."""
    found = [2 * float(ndtr(-abs(value) / (by_hand**2 + (WIDENING * sd) ** 2) ** 0.5)) for value, sd, by_hand in zeros]
    return min(1.0, len(found) * min(found)) if found else 1.0


def agreement(problem: Problem, fit: Fitted) -> float:
    """Return the same for all recordings before which zeros were set."""
    return probability([zero for run in sorted(problem.zeroed) for zero in zeros_in(fit, run)])

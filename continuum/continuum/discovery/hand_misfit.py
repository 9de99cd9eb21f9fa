"""Values that were measured by hand, compared with those of a set of effects."""

from __future__ import annotations

from scipy.special import chdtrc

from continuum.discovery.fitted import Fitted
from continuum.discovery.problem import Problem, ValueKey
from continuum.dynamics.effect_lookup import effect_named

SPREAD = 2.0
"""Factor of a fitted value's standard deviation: on the benchmark's arms 95 % intervals hold the truth in 65 of 100
cases, as those of half the deviation would."""


def value_and_sd(fit: Fitted, key: ValueKey, run: int | None = None) -> tuple[float, float]:
    """What a set makes of a value, in a recording of one that differs; where the set lacks it, none with certainty."""
    effect, name, joint = key
    spec, variance = effect_named(effect).parameters[name], 0.0
    active = fit.state.active.get(effect, {})
    if name in active:
        value = float(active[name][max(joint, 0)])
    else:
        own = fit.state.own[run].get(key, 0.0) if run is not None else 0.0
        value = (spec.default or 0.0) + fit.state.shared.get(key, 0.0) + own
    those = [*zip(fit.unknowns.common, fit.sd, strict=True)]
    those += zip(fit.unknowns.own[run], fit.own_sd[run], strict=True) if run is not None else ()
    for one, sd in those:
        if key in one.places:
            variance += float(((value if one.is_log else one.places[key]) * sd) ** 2)
    return value, variance**0.5


def misfit(problem: Problem, fit: Fitted) -> float:
    """Sum of squared differences between measured values and a set's, by their variances; chi-squared distributed."""
    found, runs = 0.0, [run.name for run in problem.runs]
    for one in problem.measured:
        run = None if one.recording is None else runs.index(one.recording)
        value, sd = value_and_sd(fit, one.key, run)
        found += (value - one.value) ** 2 / (one.sd**2 + (SPREAD * sd) ** 2)
    return found


def probability(problem: Problem, fit: Fitted) -> float:
    """Probability of a misfit as large or larger under a set; 1 where nothing was measured."""
    return float(chdtrc(len(problem.measured), misfit(problem, fit))) if problem.measured else 1.0

"""Screening by open-loop sensitivities: the gain of one more effect by one step from a fit (score test, Rao 1948).

The filter's screening rests on a linearisation from row to row; this one rests on the exact equations over whole
segments, in the same simulations that decide. One pass serves all effects whose sizes enter linearly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import mean_error
from continuum.discovery.fit_result import Fitted
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.normal_equations import Values, independent
from continuum.discovery.output_error import OutputError
from continuum.discovery.segment import Segment
from continuum.discovery.sensitivities import Sensitivities, padded
from continuum.discovery.unknowns import Unknowns


class Promise(NamedTuple):
    """The expected gain of one step with a hypothesis.

    Attributes:
        gain: fall of the log error, minus what as many unknowns gain by chance (Akaike 1974).
        observations: number of independent residuals after the step.
        hypothesis: the added hypothesis.
        near: the fit of the set with the hypothesis and values after one step.
    """

    gain: float
    observations: float
    hypothesis: Hypothesis
    near: Fitted


def promises(judge: OutputError, fit: Fitted, library: Library, instead_of: Hypothesis | None = None) -> list[Promise]:
    """Return the expected gain of each hypothesis whose size enters linearly, the best first.

    Args:
        judge: output-error fits of the recordings.
        fit: fit of a set.
        library: library with the hypotheses.
        instead_of: hypothesis of the set, with a linear size, that each one replaces.
    """
    about = Sensitivities(judge, fit, library)
    if not about.completed:
        return []
    before = _log_error(about.stepped(fit.unknowns, fit.values)[1])
    there, (kept, values) = (
        [_less(one, about.wide, fit.values, instead_of) for one in about.segments],
        _without(fit, instead_of),
    )
    found = list[Promise]()
    for h in about.hypotheses:
        unknowns = about.with_effect(kept, h)
        after, residuals = about.stepped(unknowns, values, there)
        squares, products = [np.sum(r**2) for r in residuals], [np.sum(r[1:] * r[:-1]) for r in residuals]
        observations = independent(sum(squares), sum(products)) * sum(r.size for r in residuals)
        by_chance = (len(unknowns.all) - len(kept.all)) / (2 * observations)
        gain, near = before - _log_error(residuals) - by_chance, replace(fit, unknowns=unknowns, values=after)
        found.append(Promise(gain, observations, h, near))
    return sorted(found, key=lambda one: -one.gain)


def _log_error(residuals: Sequence[Array]) -> float:
    return float(np.log(mean_error(np.array([np.sqrt(np.mean(r**2)) for r in residuals]))))


def _without(fit: Fitted, left: Hypothesis | None) -> tuple[Unknowns, Values]:
    """Return the unknowns and values of a fit except those of one hypothesis."""
    lists, values = [fit.unknowns.common, *fit.unknowns.per_run], [fit.values.common, *fit.values.per_run]
    kept = [[k for k, one in enumerate(those) if left is None or one.hypothesis is not left] for those in lists]
    common, *per_run = [[those[k] for k in ks] for those, ks in zip(lists, kept, strict=True)]
    of_all, *of_runs = [x[ks] for x, ks in zip(values, kept, strict=True)]
    return fit.unknowns.with_lists(common, per_run), Values(of_all, tuple(of_runs), fit.values.local)


def _less(one: Segment, wide: Unknowns, fitted: Values, left: Hypothesis | None) -> Segment:
    """Return a segment with the residuals of the set without a hypothesis."""
    if left is None:
        return one
    filled, every = padded(fitted, wide), [*wide.common, *wide.per_run[one.run]]
    values = np.concatenate([filled.common, filled.per_run[one.run]]) - [unknown.absent for unknown in every]
    gone = [k for k, unknown in enumerate(every) if unknown.hypothesis is left]
    return one.with_residuals(one.residuals - one.jacobian[:, gone] @ values[gone])

"""Screening by open-loop sensitivities: what one more effect would gain by one step from a fit (score test, Rao 1948).

The filter's screening rests on a linearisation from row to row; this one on the exact equations over whole segments, by
the same simulations that decide. One pass serves all effects whose sizes enter linearly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import mean_error
from continuum.discovery.fitted import Fitted
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.normal_equations import Values, independent
from continuum.discovery.output_error import OutputError
from continuum.discovery.segment import Segment
from continuum.discovery.sensitivities import Sensitivities, padded
from continuum.discovery.unknowns import Unknowns


class Promise(NamedTuple):
    """What one step with a hypothesis promises.

    Attributes:
        gain: by how much it lowers the logarithm of the error, less what as many unknowns gain by chance (Akaike 1974).
        observations: residuals that are independent after it, their number.
        hypothesis: which.
        near: the fit of the set with its values after one step to those with the hypothesis.
    """

    gain: float
    observations: float
    hypothesis: Hypothesis
    near: Fitted


def promises(judge: OutputError, fit: Fitted, library: Library, instead_of: Hypothesis | None = None) -> list[Promise]:
    """What each hypothesis whose size enters linearly promises, the best first.

    Args:
        judge: by which the set was fitted.
        fit: of a set.
        library: with the hypotheses.
        instead_of: one of the set, whose size enters linearly, that leaves it for the other.
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
    """Unknowns and values of a fit but those of one hypothesis."""
    lists, values = [fit.unknowns.common, *fit.unknowns.per_run], [fit.values.common, *fit.values.per_run]
    kept = [[k for k, one in enumerate(those) if left is None or one.hypothesis is not left] for those in lists]
    common, *per_run = [[those[k] for k in ks] for those, ks in zip(lists, kept, strict=True)]
    of_all, *of_runs = [x[ks] for x, ks in zip(values, kept, strict=True)]
    return fit.unknowns.with_lists(common, per_run), Values(of_all, tuple(of_runs), fit.values.local)


def _less(one: Segment, wide: Unknowns, fitted: Values, left: Hypothesis | None) -> Segment:
    """A segment with the residuals that stay where a hypothesis leaves the set."""
    if left is None:
        return one
    filled, every = padded(fitted, wide), [*wide.common, *wide.per_run[one.run]]
    values = np.concatenate([filled.common, filled.per_run[one.run]]) - [unknown.absent for unknown in every]
    gone = [k for k, unknown in enumerate(every) if unknown.hypothesis is left]
    return one.with_residuals(one.residuals - one.jacobian[:, gone] @ values[gone])

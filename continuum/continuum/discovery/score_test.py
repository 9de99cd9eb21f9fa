"""Screening by open-loop sensitivities: what one more effect would gain by one step from a fit (score test, Rao 1948).

The filter's screening rests on a linearisation from row to row; this one on the exact equations over whole segments, by
the same simulations that decide. One pass serves all effects whose sizes enter linearly.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import mean_error
from continuum.discovery.fitted import Fitted
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.normal_equations import NormalEquations, Scale, Values, independent
from continuum.discovery.open_loop import Segment
from continuum.discovery.output_error import DAMPING, OutputError
from continuum.discovery.unknowns import Unknown, Unknowns, linear_unknown, own_unknowns


class Promise(NamedTuple):
    """What one step with a hypothesis promises.

    Attributes:
        gain: by how much it lowers the logarithm of the error, less what as many unknowns gain by chance (Akaike 1974).
        observations: residuals that are independent after it, their number.
        hypothesis: which.
    """

    gain: float
    observations: float
    hypothesis: Hypothesis


def promises(judge: OutputError, fit: Fitted, library: Library, instead_of: Hypothesis | None = None) -> list[Promise]:
    """What each hypothesis whose size enters linearly promises, the best first.

    Args:
        judge: by which the set was fitted.
        fit: of a set.
        library: with the hypotheses.
        instead_of: one of the set, whose size enters linearly, that leaves it for the other.
    """
    runs = range(len(fit.values.own))
    linear = [h for h in library.hypotheses if is_linear(h)]
    common = [[linear_unknown(h, k, library) for k in range(len(h.coefficients))] for h in linear]
    own = [[own_unknowns(h, library, r, {}) for h in linear] for r in runs]
    wide = _joined(fit.unknowns, _once(common), [_once(own[r]) for r in runs])
    segments = judge.simulated(wide, _values(fit.values, wide))
    if not all(np.isfinite(one.square) for one in segments):
        return []
    weights = Scale(segments, judge.floor).weights([one.error for one in segments])

    at = [{one.place: k for k, one in enumerate([*wide.common, *mine])} for mine in wide.own]

    def after(there: Sequence[Segment], unknowns: Unknowns, values: Values) -> list[Array]:
        """Residuals after a step."""
        chosen = [_columns(one, at[one.run], unknowns, len(judge.local_precision)) for one in there]
        normal = NormalEquations(unknowns, _values(values, unknowns), chosen, weights, judge.local_precision)
        return normal.expected_residuals(normal.stepped(DAMPING))

    before = _log_error(after(segments, fit.unknowns, fit.values))
    there, (kept, values) = [_less(one, wide, fit.values, instead_of) for one in segments], _without(fit, instead_of)
    found = list[Promise]()
    for h, more, mine in zip(linear, common, zip(*own, strict=True), strict=True):
        residuals = after(there, _joined(kept, more, mine), values)
        squares, products = [np.sum(r**2) for r in residuals], [np.sum(r[1:] * r[:-1]) for r in residuals]
        observations = independent(sum(squares), sum(products)) * sum(r.size for r in residuals)
        by_chance = (len(more) + sum(map(len, mine))) / (2 * observations)
        found.append(Promise(before - _log_error(residuals) - by_chance, observations, h))
    return sorted(found, key=lambda one: -one.gain)


def _log_error(residuals: Sequence[Array]) -> float:
    return float(np.log(mean_error(np.array([np.sqrt(np.mean(r**2)) for r in residuals]))))


def is_linear(h: Hypothesis) -> bool:
    """Whether sizes of a hypothesis enter linearly."""
    return h.start is None and all(c.kind == "slot" for c in h.coefficients)


def _without(fit: Fitted, left: Hypothesis | None) -> tuple[Unknowns, Values]:
    """Unknowns and values of a fit but those of one hypothesis."""
    lists, values = [fit.unknowns.common, *fit.unknowns.own], [fit.values.common, *fit.values.own]
    kept = [[k for k, one in enumerate(those) if left is None or one.hypothesis is not left] for those in lists]
    common, *own = [[those[k] for k in ks] for those, ks in zip(lists, kept, strict=True)]
    of_all, *of_runs = [x[ks] for x, ks in zip(values, kept, strict=True)]
    return fit.unknowns.with_lists(common, own), Values(of_all, tuple(of_runs), fit.values.local)


def _joined(unknowns: Unknowns, more: Sequence[Unknown], more_own: Sequence[Sequence[Unknown]]) -> Unknowns:
    own = [[*those, *new] for those, new in zip(unknowns.own, more_own, strict=True)]
    return unknowns.with_lists([*unknowns.common, *more], own)


def _once(unknowns: Sequence[Sequence[Unknown]]) -> list[Unknown]:
    """One for each place."""
    return list({one.place: one for those in unknowns for one in those}.values())


def _values(values: Values, unknowns: Unknowns) -> Values:
    """The same values, and zero for further unknowns."""
    common = np.pad(values.common, (0, len(unknowns.common) - len(values.common)))
    own = [np.pad(x, (0, len(those) - len(x))) for x, those in zip(values.own, unknowns.own, strict=True)]
    return Values(common, tuple(own), values.local)


def _less(one: Segment, wide: Unknowns, fitted: Values, left: Hypothesis | None) -> Segment:
    """A segment with the residuals that stay where a hypothesis leaves the set."""
    if left is None:
        return one
    padded, every = _values(fitted, wide), [*wide.common, *wide.own[one.run]]
    values = np.concatenate([padded.common, padded.own[one.run]])
    gone = [k for k, unknown in enumerate(every) if unknown.hypothesis is left]
    slopes = one.slopes.copy()
    slopes[:, -1] -= slopes[:, gone] @ values[gone]
    return Segment(one.run, one.rows, one.readings, slopes)


def _columns(one: Segment, at: Mapping[tuple[object, ...], int], unknowns: Unknowns, local: int) -> Segment:
    """A segment with the derivatives by some unknowns only, which stand at given columns, and by its own."""
    some, width = [at[each.place] for each in (*unknowns.common, *unknowns.own[one.run])], one.slopes.shape[1]
    return Segment(one.run, one.rows, one.readings, one.slopes[:, [*some, *range(width - local - 1, width)]])

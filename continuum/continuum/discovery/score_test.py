"""Screening by open-loop sensitivities: what one more effect would gain by one step from a fit (score test, Rao 1948).

The filter's screening rests on a linearisation from row to row; this one on the exact equations over whole segments, by
the same simulations that decide. One pass serves all effects whose sizes enter linearly.
"""

from __future__ import annotations

from collections.abc import Sequence
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

    def after(left: Hypothesis | None, more: Sequence[Unknown], more_own: Sequence[list[Unknown]]) -> list[Array]:
        """Residuals after a step, without one hypothesis and with further unknowns."""
        kept, values = _without(fit, left)
        part = _joined(kept, more, more_own)
        chosen = [_columns(one, wide, part, fit.values, left) for one in segments]
        normal = NormalEquations(part, _values(values, part), chosen, weights, judge.local_precision)
        return normal.expected_residuals(normal.stepped(DAMPING))

    before, found = _log_error(after(None, [], [[] for _ in runs])), list[Promise]()
    for h, more, more_own in zip(linear, common, zip(*own, strict=True), strict=True):
        residuals = after(instead_of, more, list(more_own))
        squares, products = [np.sum(r**2) for r in residuals], [np.sum(r[1:] * r[:-1]) for r in residuals]
        observations = independent(sum(squares), sum(products)) * sum(r.size for r in residuals)
        by_chance = (len(more) + sum(map(len, more_own))) / (2 * observations)
        found.append(Promise(before - _log_error(residuals) - by_chance, observations, h))
    return sorted(found, key=lambda one: -one.gain)


def _log_error(residuals: Sequence[Array]) -> float:
    return float(np.log(mean_error(np.array([np.sqrt(np.mean(r**2)) for r in residuals]))))


def is_linear(h: Hypothesis) -> bool:
    """Whether sizes of a hypothesis enter linearly."""
    return h.start is None and all(c.kind == "slot" for c in h.coefficients)


def _without(fit: Fitted, left: Hypothesis | None) -> tuple[Unknowns, Values]:
    """Unknowns and values of a fit but those of one hypothesis."""
    common = [k for k, one in enumerate(fit.unknowns.common) if left is None or one.hypothesis is not left]
    own = [
        [k for k, one in enumerate(those) if left is None or one.hypothesis is not left] for those in fit.unknowns.own
    ]
    unknowns = fit.unknowns.with_lists(
        [fit.unknowns.common[k] for k in common],
        [[those[k] for k in mine] for those, mine in zip(fit.unknowns.own, own, strict=True)],
    )
    by_run = tuple(x[mine] for x, mine in zip(fit.values.own, own, strict=True))
    return unknowns, Values(fit.values.common[common], by_run, fit.values.local)


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


def _columns(one: Segment, wide: Unknowns, part: Unknowns, fitted: Values, left: Hypothesis | None) -> Segment:
    """A segment with the derivatives by some of its unknowns only, and the residuals without what has left the set."""
    K, M = len(wide.common), len(wide.own[one.run])
    every, some = [*wide.common, *wide.own[one.run]], [*part.common, *part.own[one.run]]
    at = {unknown.place: k for k, unknown in enumerate(every)}
    slopes = one.slopes[:, [*(at[unknown.place] for unknown in some), *range(K + M, one.slopes.shape[1])]]
    if left is not None:
        values = np.zeros(K + M)
        values[: len(fitted.common)], values[K : K + len(fitted.own[one.run])] = fitted.common, fitted.own[one.run]
        gone = [k for k, unknown in enumerate(every) if unknown.hypothesis is left]
        slopes[:, -1] -= one.slopes[:, gone] @ values[gone]
    return Segment(one.run, one.rows, one.readings, slopes)

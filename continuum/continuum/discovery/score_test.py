"""Screening by open-loop sensitivities: what one more effect would gain by one step from a fit (score test, Rao 1948).

The filter's screening rests on a linearisation from row to row; this one on the exact equations over whole segments, by
the same simulations that decide. One pass serves all effects whose sizes enter linearly.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.discovery.candidate import mean_error
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.normal_equations import NormalEquations, Scale, Values
from continuum.discovery.open_loop import Segment
from continuum.discovery.output_error import DAMPING, Fitted, OutputError
from continuum.discovery.unknowns import Unknown, Unknowns, linear_unknown, own_unknowns


def expected_gains(judge: OutputError, fit: Fitted, library: Library) -> list[tuple[float, Hypothesis]]:
    """By how much each hypothesis lowers the logarithm of the error, the best first.

    Args:
        judge: by which the set was fitted.
        fit: of a set.
        library: with the hypotheses.
    """
    runs = range(len(fit.values.own))
    linear = [h for h in library.hypotheses if h.start is None and all(c.kind == "slot" for c in h.coefficients)]
    common = [[linear_unknown(h, k, library) for k in range(len(h.coefficients))] for h in linear]
    own = [[own_unknowns(h, library, r, {}) for h in linear] for r in runs]
    wide = _joined(fit.unknowns, _once(common), [_once(own[r]) for r in runs])
    segments = judge.simulated(wide, _values(fit.values, wide))
    if not all(np.isfinite(one.square) for one in segments):
        return []
    scale = Scale(segments, judge.floor)

    def error(more: list[Unknown], more_own: list[list[Unknown]]) -> float:
        part = _joined(fit.unknowns, more, more_own)
        chosen = [_columns(one, wide, part, fit.unknowns) for one in segments]
        normal = NormalEquations(part, _values(fit.values, part), chosen, scale, judge.local_precision)
        squares = np.array(normal.expected_squares(normal.stepped(DAMPING)))
        return mean_error(np.sqrt(squares / [one.readings.size for one in segments]))

    alone = error([], [[] for _ in runs])
    gains = [np.log(alone / error(common[i], [own[r][i] for r in runs])) for i in range(len(linear))]
    return sorted(zip(map(float, gains), linear, strict=True), key=lambda pair: -pair[0])


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


def _columns(one: Segment, wide: Unknowns, part: Unknowns, base: Unknowns) -> Segment:
    """A segment with the derivatives by some of its unknowns only."""
    K, M = len(wide.common), len(wide.own[one.run])
    common = _positions(wide.common, part.common, len(base.common))
    own = _positions(wide.own[one.run], part.own[one.run], len(base.own[one.run]))
    rest = range(K + M, one.slopes.shape[1])
    return Segment(one.run, one.rows, one.readings, one.slopes[:, [*common, *(K + i for i in own), *rest]])


def _positions(wide: Sequence[Unknown], part: Sequence[Unknown], base: int) -> list[int]:
    """Where a part's unknowns stand, the first ones being those of the fit."""
    at = {one.place: base + i for i, one in enumerate(wide[base:])}
    return [*range(base), *(at[one.place] for one in part[base:])]

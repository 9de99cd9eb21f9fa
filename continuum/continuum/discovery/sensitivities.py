"""Open-loop sensitivities of one fit to all effects whose sizes enter linearly: one simulation of every segment."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.arrays import Array
from continuum.discovery.fit_result import Fitted
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.normal_equations import NormalEquations, Scale, Values
from continuum.discovery.output_error import DAMPING, OutputError
from continuum.discovery.segment import Segment
from continuum.discovery.unknowns import Unknown, Unknowns, linear_unknown, run_unknowns


class Sensitivities:
    """Residuals of a fit, and their derivatives with respect to the fitted values and all further effects.

    Args:
        judge: output-error fits of the recordings.
        fit: fit of a set.
        library: library with the hypotheses.

    Attributes:
        hypotheses: the linear ones.
        wide: the unknowns of the fit and those of all hypotheses.
        segments: segments with derivatives by these.
    """

    def __init__(self, judge: OutputError, fit: Fitted, library: Library) -> None:
        self._judge, runs = judge, range(len(fit.values.per_run))
        self.hypotheses = [h for h in library.hypotheses if is_linear(h)]
        common = [[linear_unknown(h, k, library) for k in range(len(h.coefficients))] for h in self.hypotheses]
        per_run = [[run_unknowns(h, library, r, {}) for h in self.hypotheses] for r in runs]
        added = zip(self.hypotheses, common, zip(*per_run, strict=True), strict=True)
        self._added = {h: (of_all, of_runs) for h, of_all, of_runs in added}
        self.wide = _joined(fit.unknowns, _once(common), [_once(per_run[r]) for r in runs])
        self.segments = judge.simulated(self.wide, padded(fit.values, self.wide))
        self._at = [{one.place: k for k, one in enumerate([*self.wide.common, *mine])} for mine in self.wide.per_run]

    @property
    def completed(self) -> bool:
        """Whether no simulation failed."""
        return all(np.isfinite(one.square) for one in self.segments)

    def _weights(self, segments: Sequence[Segment]) -> list[float]:
        return Scale(segments, self._judge.floor).weights([one.error for one in segments])

    def with_effect(self, unknowns: Unknowns, h: Hypothesis) -> Unknowns:
        """Return some unknowns with those of a hypothesis."""
        return _joined(unknowns, *self._added[h])

    def stepped(
        self,
        unknowns: Unknowns,
        values: Values,
        segments: Sequence[Segment] | None = None,
        scaled_by: Sequence[Segment] | None = None,
    ) -> tuple[Values, list[Array]]:
        """Return the values after a step of some of the unknowns, and the residuals there, (rows, n) per segment [rad].

        Args:
            unknowns: unknowns of the step.
            values: start of the step; unknowns beyond these start at 0.
            segments: segments with other residuals; the fit's if None.
            scaled_by: segments whose residuals set the weights; the fit's if None.
        """
        local = len(self._judge.local_precision)
        chosen = [self._by(one, unknowns, local) for one in segments or self.segments]
        start = padded(values, unknowns)
        weights = self._weights(scaled_by or self.segments)
        normal = NormalEquations(unknowns, start, chosen, weights, self._judge.local_precision)
        there = normal.stepped(DAMPING)
        return there, normal.expected_residuals(there)

    def _by(self, one: Segment, unknowns: Unknowns, local: int) -> Segment:
        """Return a segment with derivatives by only some unknowns and its local ones."""
        at, width = self._at[one.run], one.jacobian.shape[1]
        some = [at[each.place] for each in (*unknowns.common, *unknowns.per_run[one.run])]
        return one.with_unknowns([*some, *range(width - local, width)])

    def changes(self, h: Hypothesis, sizes: Array, per_run_sizes: Array) -> list[Segment]:
        """Return segments whose residuals are those that a hypothesis would leave if it were true in the data.

        Args:
            h: one of the linear hypotheses.
            sizes: sizes of its unknowns that all recordings share, (k,).
            per_run_sizes: sizes of its per-run unknowns, (m,), with a sign that alternates from run to run.
        """
        of_all, of_runs = self._added[h]
        found = []
        for one in self.segments:
            at, sign = self._at[one.run], 1 - 2 * (one.run % 2)
            columns = [at[each.place] for each in (*of_all, *of_runs[one.run])]
            found.append(one.with_residuals(-one.jacobian[:, columns] @ np.concatenate([sizes, sign * per_run_sizes])))
        return found


def is_linear(h: Hypothesis) -> bool:
    """Whether the sizes of a hypothesis enter linearly."""
    return h.start is None and all(c.kind == "slot" for c in h.coefficients)


def padded(values: Values, unknowns: Unknowns) -> Values:
    """Return the same values, with zero for further unknowns."""
    common = np.pad(values.common, (0, len(unknowns.common) - len(values.common)))
    per_run = [np.pad(x, (0, len(those) - len(x))) for x, those in zip(values.per_run, unknowns.per_run, strict=True)]
    return Values(common, tuple(per_run), values.local)


def _joined(unknowns: Unknowns, more: Sequence[Unknown], more_per_run: Sequence[Sequence[Unknown]]) -> Unknowns:
    per_run = [[*those, *new] for those, new in zip(unknowns.per_run, more_per_run, strict=True)]
    return unknowns.with_lists([*unknowns.common, *more], per_run)


def _once(unknowns: Sequence[Sequence[Unknown]]) -> list[Unknown]:
    """Return one unknown for each place."""
    return list({one.place: one for those in unknowns for one in those}.values())

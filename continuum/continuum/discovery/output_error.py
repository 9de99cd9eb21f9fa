"""Fit of a set of effects by output error: open-loop simulations of the exact equations against the readings.

Segmented output error: recordings are cut into segments, as in multiple shooting (Bock 1983) but without conditions
between them, each with unknown initial angles, rates and zeros of its sensors. The posture in which a joint comes to
rest is very sensitive to friction, which leaves kinks in the cost: segments are short, so that most end before that,
and Levenberg-Marquardt steps may raise the cost slightly.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import mean_error
from continuum.discovery.decision import ALIKE, is_worth
from continuum.discovery.fit_result import Fitted, OpenLoop
from continuum.discovery.normal_equations import NormalEquations, Scale, Values, prior_cost
from continuum.discovery.open_loop import RunSimulation, Simulators
from continuum.discovery.problem import Problem, State
from continuum.discovery.search import Found
from continuum.discovery.segment import Segment, cut
from continuum.discovery.starts import AT_REST, FAR_AT_REST, as_given, at_rest
from continuum.discovery.unknowns import Start, Unknowns, linear_unknown
from continuum.dynamics.trajectory import Trajectory as Motion
from continuum.recordings.recording import Recording

SEGMENT = 0.5
"""Length of a segment [s]: about one swing of an arm's slowest mode. Errors of the equations show within it; with 2 s
segments, fits ended 1.5 to 4 times above the noise, because joints came to rest elsewhere."""
ENOUGH = 16
"""Number of segments to simulate, evenly distributed over all recordings, or two of each if these are many: the time of
a fit does not grow with their length. A second segment tests a recording's per-run values."""
_FIRST = 2  # steps, after which the best start is followed and a poor fit is abandoned
_ITERATIONS = 5  # further steps at most
_MOST = 12  # steps of a fit that is not compared with others
_FAR = 2.0  # multiple of another set's error above which a set is not fitted further
_SETTLED = 1.0  # fall of minus the log-posterior: less changes no decision
_STILL = 2  # consecutive steps with less, after which a fit ends
_RISE = 0.2  # relative rise of errors that a step may cause
_SHARES = (0.5, 0.25)  # fractions of a step of a segment's local unknowns to try if its error rises by more
DAMPING, _MORE = 1e-4, 100.0  # of Levenberg and Marquardt, and the factor by which it grows if the cost rises
_MOST_DAMPING = 1.0  # halves a step, and steps of all directions alike
_BEGINNING = (0.1, 1.0)  # rad, rad/s: prior standard deviations of a segment's initial state about the smoothed one


@dataclass(frozen=True)
class _Iterate:
    """Values, segments simulated there, and whether steps settled there."""

    unknowns: Unknowns
    values: Values
    segments: Sequence[Segment]
    settled: bool = False

    @property
    def completed(self) -> bool:
        return all(np.isfinite(one.square) for one in self.segments)

    @property
    def error(self) -> float:
        """Geometric mean over the segments [rad]; infinite where a simulation failed."""
        return float(mean_error(np.array([one.error for one in self.segments])))


class OutputError:
    """Fits of one problem's recordings.

    Args:
        problem: problem with the runs.
        recordings: recordings with the inputs of the runs.
    """

    def __init__(self, problem: Problem, recordings: Sequence[Recording]) -> None:
        self.problem, self._simulators = problem, Simulators(problem, tuple(recordings))
        n = problem.structure.n
        sd = np.concatenate([np.repeat(_BEGINNING, n), problem.noise.slow])
        self.local_precision = sd**-2.0
        cuts = [cut(run.times, SEGMENT) for run in problem.runs]
        apart = max(1, round(sum(map(len, cuts)) / ENOUGH))
        self._cuts = [rows[:: min(apart, max(1, len(rows) - 1))] for rows in cuts]  # at least two of each recording

    def around(self, problem: Problem) -> OutputError:
        """Return the same for another problem with the same structure, recordings and rows."""
        other = copy(self)
        other.problem, other._simulators = problem, self._simulators.around(problem)
        return other

    def along(self, problem: Problem, recordings: Sequence[Recording]) -> OutputError:
        """Return the same for other recordings, with all of their segments."""
        other = copy(self)
        other.problem, other._simulators = problem, self._simulators.around(problem, tuple(recordings))
        other._cuts = [cut(run.times, SEGMENT) for run in problem.runs]
        return other

    @property
    def segments(self) -> int:
        """Number of segments."""
        return sum(map(len, self._cuts))

    def motion(self, state: State, run: int) -> tuple[Motion, Array]:
        """Simulate a whole run from the start of the state's trajectory; return the motion and the angles as read."""
        rows, none = slice(0, len(self.problem.runs[run].times)), np.zeros(len(self.local_precision))
        simulation = RunSimulation(self._simulators, state, run)
        return simulation.motion(rows, none), simulation.readings(rows, none)

    @cached_property
    def floor(self) -> float:
        """Root mean square of the white noise of an angle [rad]."""
        n = self.problem.structure.n
        return float(np.sqrt(np.mean(np.diag(self.problem.noise.white)[:n])))

    def fit(self, found: Found, near: Sequence[Fitted]) -> Fitted:
        """Fit a set.

        Args:
            found: the set with the state in which a search left it.
            near: fits of other sets to start from, in addition to that state if its trajectories differ from theirs;
                multi-start if empty.
        """
        starts = [self._start(found, one) for one in near]
        if near and all(one.state.ways is not found.lin.state.ways for one in near):
            starts.insert(0, ({}, None))
        if near and not near[0].key:  # what the baseline fits as friction of all joints may belong to one
            starts.append((as_given(self.problem, found), None))
        if not near:
            rises = [at_rest(self.problem, found, rise) for rise in AT_REST]
            starts = [(start, None) for start in (as_given(self.problem, found), *rises)]
        nearest = min((one.error for one in near), default=self.floor)
        best = self._optimum(self._begun(found, *starts[0]), _FIRST)
        for start in starts[1:]:
            if best.error < (1 + ALIKE) * max(nearest, self.floor):
                break
            best = min(best, self._optimum(self._begun(found, *start), _FIRST), key=lambda one: one.error)
        if near and (best.error > _FAR * nearest or self._gains_nothing(found, best, near[0])):
            return self._fitted(best)
        return self._fitted(self._optimum(best, _ITERATIONS))

    def _gains_nothing(self, found: Found, there: _Iterate, part: Fitted) -> bool:
        """Whether a set's further effects have not gained enough over a part of it so far."""
        observations = Scale(there.segments, self.floor).observations
        return part.key < found.key and not is_worth(np.log(part.error / there.error), observations)

    def further(self, found: Found, fit: Fitted, least: float = np.inf) -> Fitted:
        """Continue a set's fit, or start it where another ended; stop early if its error is above ``least`` [rad]."""
        there = self._optimum(self._begun(found, *self._start(found, fit)), _FIRST)
        return self._fitted(there if there.error > least else self._optimum(there, _ITERATIONS - _FIRST))

    def multi_start(self, found: Found, near: Sequence[Fitted] = ()) -> Fitted:
        """Fit a set from the ends of other fits, from the model file's values and from other frictions near rest.

        Every start is followed to its end, which an identification can afford.
        """
        rises = [at_rest(self.problem, found, rise) for rise in FAR_AT_REST]
        starts = [(start, None) for start in ({}, as_given(self.problem, found), *rises)]
        return min(
            (self.followed(found, *start) for start in (*starts, *(self._start(found, one) for one in near))),
            key=lambda one: one.error,
        )

    def followed(self, found: Found, start: Start, local: Sequence[Array] | None) -> Fitted:
        """Fit a set from one start to its end."""
        return self._fitted(self._optimum(self._begun(found, start, local), _MOST))

    def whole(self, fit: Fitted) -> OpenLoop:
        """Simulate every recording from the start of its first segment."""
        number, found = 0, []
        for r, run in enumerate(self.problem.runs):
            simulation = RunSimulation(self._simulators, fit.state, r)
            found.append(simulation.readings(slice(0, len(run.times)), fit.values.local[number]))
            number += len(self._cuts[r])
        return OpenLoop(tuple(found), self.floor, fit.error)

    def readings(self, state: State, values: Values, every: int = 1) -> list[Array | None]:
        """Simulate segments at a state with the local unknowns of ``values``, (rows, n) each [rad]; NaN if one fails.

        Only one in ``every`` segments is simulated; the others are None.
        """
        local, found = iter(values.local), list[Array | None]()
        for r, rows in enumerate(self._cuts):
            simulation = RunSimulation(self._simulators, state, r)
            for one in rows:
                begin = next(local)
                found.append(None if len(found) % every else simulation.readings(one, begin))
        return found

    def _start(self, found: Found, fit: Fitted) -> tuple[Start, Sequence[Array] | None]:
        """Return where another set's fit ended: its unknowns, and local ones if about the same trajectories, else None.

        Further effects start absent if that set is a part of this one, else where the search left them.
        """
        start, had = fit.start, fit.key
        if had <= found.key:
            new, library = [h for h in found.chosen if h.key not in had], found.lin.library
            slots = [(h, k) for h in new for k, c in enumerate(h.coefficients) if c.kind == "slot"]
            start = {linear_unknown(h, k, library).key: 0.0 for h, k in slots} | start
        return start, fit.values.local if fit.state.ways is found.lin.state.ways else None

    def _begun(self, found: Found, start: Start, local: Sequence[Array] | None) -> _Iterate:
        """Return the start of a fit, given some unknowns."""
        unknowns = Unknowns(self.problem, found, start)
        none = np.zeros(len(self.local_precision))
        common = np.array([one.start for one in unknowns.common])
        values = Values(common, unknowns.per_run_start, tuple(local or (none for rows in self._cuts for _ in rows)))
        return _Iterate(unknowns, values, self.simulated(unknowns, values))

    def _optimum(self, here: _Iterate, iterations: int) -> _Iterate:
        """Return the best of some Levenberg-Marquardt steps."""
        best, damping, still = here, DAMPING, 0
        for _ in range(0 if here.settled else iterations):
            if not here.completed:
                break
            normal, scale = self._normal(here), Scale(best.segments, self.floor)
            trial, cost = normal.stepped(damping), self._cost(best, scale)
            if here is best and damping == DAMPING and normal.expected_fall(trial) < _SETTLED:
                return replace(best, settled=True)
            there = self._stepped(here, trial)
            fall = cost - self._cost(there, scale)
            if fall > -_RISE * scale.observations:
                here, damping = there, max(damping / _MORE, DAMPING)
                still = 0 if fall > _SETTLED else still + 1
            else:
                damping *= _MORE
            if fall > 0:
                best = there
            if still == _STILL:
                return replace(best, settled=True)
            if damping > _MOST_DAMPING:
                break
        return best

    def _stepped(self, here: _Iterate, trial: Values) -> _Iterate:
        """Simulate every segment after a step."""
        unknowns, found = here.unknowns, list[tuple[Segment, Array]]()
        before = iter(zip(here.segments, here.values.local, trial.local, strict=True))
        for run, rows in self._runs(unknowns, trial):
            found += [self._shortened(run, one, *next(before)) for one in rows]
        segments, local = zip(*found, strict=True)
        return _Iterate(unknowns, replace(trial, local=local), segments)

    def _shortened(
        self, run: RunSimulation, rows: slice, before: Segment, begin: Array, end: Array
    ) -> tuple[Segment, Array]:
        """Return a segment after a step and its local unknowns; their step is shortened if the error rises too much."""
        best, local = run.segment(rows, end), end
        for share in _SHARES:
            if best.error < (1 + _RISE) * max(before.error, self.floor):
                break
            other = run.segment(rows, begin + share * (end - begin))
            if other.error < best.error or not np.isfinite(best.error):
                best, local = other, begin + share * (end - begin)
        return best, local

    def _normal(self, at: _Iterate) -> NormalEquations:
        weights = Scale(at.segments, self.floor).weights([one.error for one in at.segments])
        return NormalEquations(at.unknowns, at.values, at.segments, weights, self.local_precision)

    def _cost(self, at: _Iterate, scale: Scale) -> float:
        """Return minus the log-posterior, up to a constant; infinite where a simulation failed."""
        cost = sum(scale.cost(one) for one in at.segments) + prior_cost(at.unknowns, at.values, self.local_precision)
        return cost if np.isfinite(cost) else np.inf

    def simulated(self, unknowns: Unknowns, values: Values) -> list[Segment]:
        """Simulate every segment, with derivatives with respect to all unknowns."""
        local = iter(values.local)
        return [run.segment(one, next(local)) for run, rows in self._runs(unknowns, values) for one in rows]

    def _runs(self, unknowns: Unknowns, values: Values) -> Iterator[tuple[RunSimulation, Sequence[slice]]]:
        """Yield each recording with the rows of its segments."""
        state = unknowns.state(values.common, values.per_run)
        for r, rows in enumerate(self._cuts):
            yield RunSimulation(self._simulators, state, r, [*unknowns.common, *unknowns.per_run[r]]), rows

    def _fitted(self, at: _Iterate) -> Fitted:
        unknowns, values = at.unknowns, at.values
        state, k = unknowns.state(values.common, values.per_run), len(values.common)
        if not at.completed:
            none = tuple(np.full(len(per_run), np.nan) for per_run in values.per_run)
            failed = np.full(len(at.segments), np.nan)
            return Fitted(state, unknowns, values, np.full(k, np.nan), np.eye(k), none, failed, 0.0, 1.0, True)
        normal = self._normal(at)
        scale = Scale(at.segments, self.floor)
        left = normal.without_each(scale)
        plain = np.sqrt(np.diag(normal.covariance))
        sd = plain * np.sqrt(np.maximum(left.disagreement, 1.0))
        agreement = left.probability([i for i, one in enumerate(unknowns.common) if one.hypothesis is not None])
        correlation = normal.covariance / np.outer(plain, plain)
        return Fitted(
            state, unknowns, values, sd, correlation, normal.per_run_sd(), left.errors, scale.observations, agreement,
            at.settled,
        )  # fmt: skip

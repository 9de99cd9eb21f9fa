"""One run simulated freely from its first instant, less what was measured, in units of the noise; with exact slopes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect
from continuum.dynamics.reading import Reading, readings
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus, Trajectory
from continuum.dynamics.values import with_vector
from continuum.identification.arrow_least_squares import RunPart
from continuum.identification.free import FreeSpace
from continuum.identification.noise import Noise
from continuum.identification.recording import Recording

_ANGLE_UNIT, _RATE_UNIT = np.deg2rad(1.0), 0.1  # of the coordinates of the initial state [rad, rad/s]
_ANGLE_SPREAD, _RATE_SPREAD = 10.0, 20.0  # prior of these coordinates
_NUDGE = 1e-5  # of a sensor's parameter, in units of its coordinate


@dataclass(frozen=True)
class Errors:
    """What is left of a run, made independent and of unit variance if the model is right, (n_times, n_joints) each."""

    angle: Array
    rate: Array | None

    @property
    def flat(self) -> Array:
        """All of it, (m,)."""
        return np.concatenate([part.ravel() for part in (self.angle, self.rate) if part is not None])


class RunResidual:
    """The residual of one recording as a function of shared unknowns and of its own.

    Its own unknowns are the joints' angles and rates where it begins, and what each recording has a value of its own of.
    It may begin anew every so often, from angles and rates of its own again (multiple shooting, Bock and Plitt 1984): a
    long free run leaves a wrong model so far behind that slopes show nothing, a short one does not. States of effects
    run on.

    Args:
        simulator: of the model.
        recording: what was measured.
        noise: of the sensors.
        shared, own: unknowns that move the model's values.
        restart: time after which it begins anew [s]; never without.
    """

    def __init__(
        self,
        simulator: Simulator,
        recording: Recording,
        noise: Noise,
        shared: FreeSpace,
        own: FreeSpace,
        restart: float | None = None,
    ) -> None:
        self.recording, self.shared, self.own = recording, shared, own
        self._simulator, self._model = simulator, simulator.model
        n = self._model.n_joints
        self._starts = _starts(recording.times, restart)
        spread = [np.full(a.effect.n_states(n), a.effect.state_spread) for a in self._model.effects]
        self._state_unit = np.concatenate([*spread, np.zeros(0)])
        self._loose = 2 * n + np.flatnonzero(self._state_unit > 0)  # states of effects whose beginning is not known
        self._motion_unit = np.concatenate([np.full(n, _ANGLE_UNIT), np.full(n, _RATE_UNIT)])
        begins = len(self._starts)
        self.start = np.zeros(2 * n * begins + self._loose.size + len(own.unknowns))
        prior = np.concatenate([np.full(n, _ANGLE_SPREAD), np.full(n, _RATE_SPREAD)])
        self.spread = np.concatenate([np.tile(prior, begins), np.ones(self._loose.size), own.spread])
        self._measured = [np.concatenate([recording.theta[row], _rate_at(recording, row)]) for row in self._starts]
        self._whiten_angle = noise.angle.whitener(recording.times)
        uses_rate = recording.theta_rate is not None and noise.rate is not None
        self._whiten_rate = noise.rate.whitener(recording.times) if uses_rate and noise.rate else None

    def part(self, shared: Array, own: Array) -> RunPart | None:
        """Errors and slopes; None where the model cannot be simulated."""
        p, k = self._values(shared, own), shared.size
        free = np.zeros((p.size, k + own.size))
        free[:, :k], free[:, k + own.size - len(self.own.unknowns) :] = self.shared.directions, self.own.directions
        run = self._run(p, own, free, k)
        if run is None or not np.all(np.isfinite(run.slopes)):
            return None
        seen = readings(with_vector(self._model, p), run)
        slopes = self._reading_slopes(p, run, seen, free)
        jacobian = np.stack([self._whitened(slope).flat for slope in slopes], axis=1)
        return RunPart(self._errors(seen).flat, jacobian[:, :k], jacobian[:, k:])

    def simulate(self, shared: Array, own: Array) -> Reading | None:
        """What the sensors would read of the model; None where it cannot be simulated."""
        p = self._values(shared, own)
        run = self._run(p, own, np.zeros((p.size, 0)), 0)
        return None if run is None else readings(with_vector(self._model, p), run)

    def _values(self, shared: Array, own: Array) -> Array:
        mine = self.own.clipped(own[own.size - len(self.own.unknowns) :])
        return self.shared.values(shared) + self.own.directions @ mine

    def _run(self, p: Array, own: Array, free: Array, k: int) -> Trajectory | None:
        """The simulation, stretch by stretch; its slopes by the columns of ``free`` and by where the stretches begin."""
        n, columns = self._model.n_joints, free.shape[1]
        times = self.recording.times
        extra, extra_slope = self._states(p, own), np.zeros((self._model.n_states, columns))
        for at, state in enumerate(self._loose - 2 * n):
            if columns:
                extra_slope[state, k + 2 * n * len(self._starts) + at] = self._state_unit[state]
        states = np.full((times.size, 2 * n + extra.size), np.nan)
        slopes = np.zeros((times.size, 2 * n + extra.size, columns))
        steps = 0
        for piece, (first, last) in enumerate(pairwise([*self._starts, times.size])):
            mine = slice(2 * n * piece, 2 * n * (piece + 1))
            x0 = np.concatenate([self._measured[piece] + self._motion_unit * own[mine], extra])
            slope0 = np.vstack([np.zeros((2 * n, columns)), extra_slope])
            if columns:
                slope0[: 2 * n, k + mine.start : k + mine.stop] = np.diag(self._motion_unit)
            to = last if last == times.size else last + 1  # to where the next begins, for the states of effects
            used = np.flatnonzero(np.any(free != 0, axis=0) | np.any(slope0 != 0, axis=0))
            run = self._simulator.run(x0, times[first:to], self.recording.pull, p, free[:, used], slope0[:, used])
            if run.status is not SimulationStatus.COMPLETE:
                return None
            states[first:to], steps = run.states, steps + run.steps
            slopes[first:to] = 0.0
            slopes[first:to, :, used] = run.slopes
            extra, extra_slope = run.states[-1, 2 * n :], slopes[to - 1, 2 * n :].copy()
        return Trajectory(SimulationStatus.COMPLETE, times, states, n, steps, 0, slopes)

    def _states(self, p: Array, own: Array) -> Array:
        """States of the effects at the first sample, (n_states,)."""
        n, model = self._model.n_joints, with_vector(self._model, p)
        theta = self._measured[0][:n] + self._motion_unit[:n] * own[:n]
        u = self.recording.pull.at(self.recording.times[0])
        states = [a.effect.initial_state(theta, u, a.values, model.parameters) for a in model.effects]
        begin = np.concatenate([*states, np.zeros(0)])
        at = 2 * n * len(self._starts)
        begin[self._loose - 2 * n] += self._state_unit[self._loose - 2 * n] * own[at : at + self._loose.size]
        return begin

    def _reading_slopes(self, p: Array, run: Trajectory, seen: Reading, free: Array) -> list[Reading]:
        """Change of what the sensors read by one unit of each unknown."""
        n, measures = run.n_joints, [type(a.effect).measure is not Effect.measure for a in self._model.effects]
        slopes = [
            Reading(run.times, run.slopes[:, :n, c], run.slopes[:, n : 2 * n, c]) for c in range(run.slopes.shape[2])
        ]
        if not any(measures):
            return slopes
        model, found = with_vector(self._model, p), []
        for column, slope in enumerate(slopes):
            moved = replace(run, states=run.states + run.slopes[:, :, column])  # measuring is affine in the motion
            by_motion = readings(model, moved)
            nudged = readings(with_vector(self._model, p + _NUDGE * free[:, column]), run)
            found.append(
                Reading(
                    slope.times,
                    by_motion.theta - seen.theta + (nudged.theta - seen.theta) / _NUDGE,
                    by_motion.theta_rate - seen.theta_rate + (nudged.theta_rate - seen.theta_rate) / _NUDGE,
                )
            )
        return found

    def _errors(self, seen: Reading) -> Errors:
        rate = self.recording.theta_rate
        return self._whitened(
            Reading(
                seen.times,
                seen.theta - self.recording.theta,
                seen.theta_rate if rate is None else seen.theta_rate - rate,
            )
        )

    def _whitened(self, difference: Reading) -> Errors:
        rate = None if self._whiten_rate is None else self._whiten_rate(difference.theta_rate)
        return Errors(self._whiten_angle(difference.theta), rate)


def _starts(times: Array, restart: float | None) -> list[int]:
    """Rows at which stretches begin: of equal length, about ``restart`` [s]."""
    if restart is None:
        return [0]
    pieces = max(1, round((times[-1] - times[0]) / restart))
    return [int(np.searchsorted(times, t)) for t in np.linspace(times[0], times[-1], pieces + 1)[:-1]]


def _rate_at(recording: Recording, row: int) -> Array:
    """Joint rates at one sample, (n_joints,) [rad/s]: measured, or of a parabola through a few angles from there on."""
    if recording.theta_rate is not None:
        return recording.theta_rate[row]
    rows = slice(row, row + 7)
    t = recording.times[rows] - recording.times[row]
    return np.asarray(np.polynomial.polynomial.polyfit(t, recording.theta[rows], min(2, t.size - 1))[1])

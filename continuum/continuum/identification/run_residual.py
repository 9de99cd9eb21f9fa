"""One run simulated freely from its first instant, less what was measured, in units of the noise; with exact slopes."""

from __future__ import annotations

from dataclasses import dataclass, replace

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

    Its own unknowns are the initial state, and what each recording has a value of its own of.

    Args:
        simulator: of the model.
        recording: what was measured.
        noise: of the sensors.
        shared, own: unknowns that move the model's values.
    """

    def __init__(
        self, simulator: Simulator, recording: Recording, noise: Noise, shared: FreeSpace, own: FreeSpace
    ) -> None:
        self.recording, self.shared, self.own = recording, shared, own
        self._simulator = simulator
        self._model = simulator.model
        n, extra = self._model.n_joints, self._model.n_states
        spread = np.concatenate(
            [np.full(a.effect.n_states(n), a.effect.state_spread) for a in self._model.effects] or [np.zeros(0)]
        )
        self._unit = np.concatenate([np.full(n, _ANGLE_UNIT), np.full(n, _RATE_UNIT), spread])
        self._moves = np.flatnonzero(self._unit > 0)
        self.start = np.zeros(self._moves.size + len(own.unknowns))
        prior = np.concatenate([np.full(n, _ANGLE_SPREAD), np.full(n, _RATE_SPREAD), np.ones(extra)])
        self.spread = np.concatenate([prior[self._moves], own.spread])
        self._whiten_angle = noise.angle.whitener(recording.times)
        uses_rate = recording.theta_rate is not None and noise.rate is not None
        self._whiten_rate = noise.rate.whitener(recording.times) if uses_rate and noise.rate else None

    def part(self, shared: Array, own: Array) -> RunPart | None:
        """Errors and slopes; None where the model cannot be simulated."""
        k = shared.size
        p, x0 = self._values(shared, own), self._initial(shared, own)
        columns = k + own.size
        free, free_initial = np.zeros((p.size, columns)), np.zeros((x0.size, columns))
        free[:, :k], free[:, k + self._moves.size :] = self.shared.directions, self.own.directions
        free_initial[self._moves, k + np.arange(self._moves.size)] = self._unit[self._moves]
        run = self._simulator.run(x0, self.recording.times, self.recording.pull, p, free, free_initial)
        if run.status is not SimulationStatus.COMPLETE or not np.all(np.isfinite(run.slopes)):
            return None
        seen = readings(with_vector(self._model, p), run)
        slopes = self._reading_slopes(p, run, seen, free)
        jacobian = np.stack([self._whitened(slope).flat for slope in slopes], axis=1)
        return RunPart(self._errors(seen).flat, jacobian[:, :k], jacobian[:, k:])

    def errors(self, shared: Array, own: Array) -> Errors | None:
        """The errors alone, by time and joint."""
        run = self.simulate(shared, own)
        return None if run is None else self._errors(run)

    def simulate(self, shared: Array, own: Array) -> Reading | None:
        """What the sensors would read of the model; None where it cannot be simulated."""
        p = self._values(shared, own)
        run = self._simulator.run(self._initial(shared, own), self.recording.times, self.recording.pull, p)
        return readings(with_vector(self._model, p), run) if run.status is SimulationStatus.COMPLETE else None

    def _values(self, shared: Array, own: Array) -> Array:
        mine = self.own.clipped(own[self._moves.size :])
        return self.shared.values(shared) + self.own.directions @ mine

    def _initial(self, shared: Array, own: Array) -> Array:
        """State at the first sample: as measured, moved by the own unknowns."""
        model = with_vector(self._model, self._values(shared, own))
        theta, rate = self.recording.theta[0], _first_rate(self.recording)
        u = self.recording.pull.at(self.recording.times[0])
        theta = theta + self._unit[: theta.size] * own[: theta.size]
        states = [a.effect.initial_state(theta, u, a.values, model.parameters) for a in model.effects]
        x0 = np.concatenate([theta, rate, *states])
        moved = self._moves[theta.size :]
        x0[moved] += self._unit[moved] * own[theta.size : self._moves.size]
        return x0

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


def _first_rate(recording: Recording) -> Array:
    """Joint rates at the first sample, (n_joints,) [rad/s]: of a parabola through the first few."""
    rows = slice(0, 7)
    t = recording.times[rows] - recording.times[0]
    if recording.theta_rate is not None:
        return np.polynomial.polynomial.polyfit(t, recording.theta_rate[rows], 1)[0]
    return np.polynomial.polynomial.polyfit(t, recording.theta[rows], 2)[1]

"""How well a model predicts runs: Eq. 19 of angles and rates, run by run (thesis Table 4 and Fig. 9).

Every run is simulated open loop from start to end. Its initial angles and rates, which no model contains, are fitted to
the run.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.optimize import least_squares

from continuum.arrays import Array
from continuum.dynamics.measuring import as_read, lateness
from continuum.dynamics.model import Model, with_dry_friction
from continuum.dynamics.simulation_input import initial_state
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus, Trajectory
from continuum.estimation.sensor_noise import recording_noise
from continuum.identification.local_derivatives import local_derivative
from continuum.identification.nrmse import measured_rates, nrmse
from continuum.recordings.recording import Recording

_MOST = 20  # simulations; nearly linear runs need four, but kinks from friction could keep the fit busy forever
_SLOPE_SD = 1.0  # rad/s, of an initial rate about the derivative of the first angles
_FAILED = 1e3  # rad, residual assigned to a simulation that fails


@dataclass(frozen=True)
class Score:
    """Score of one run.

    Attributes:
        recording: the run.
        theta: simulated angles as the sensors would read them, (n_times, n_joints) [rad]; NaN where it failed.
        position, rate: Eq. 19 of angles and rates; NaN where the simulation failed.
    """

    recording: Recording
    theta: Array
    position: float
    rate: float

    @property
    def rms(self) -> float:
        """Root mean square error over rows and joints [rad]."""
        return float(np.sqrt(np.mean((self.theta - self.recording.theta) ** 2)))


def scores(model: Model, recordings: Sequence[Recording]) -> tuple[Score, ...]:
    """Return the score of every run."""
    simulator = Simulator(with_dry_friction(model))
    return tuple(_score(simulator, run) for run in recordings)


def _score(simulator: Simulator, recording: Recording) -> Score:
    found = nearest_simulation(simulator, recording)
    if found.status is not SimulationStatus.COMPLETE:
        return Score(recording, np.full_like(recording.theta, np.nan), np.nan, np.nan)
    seen = as_read(simulator.model, found)
    # if rates were not measured, take derivatives of both angles, so that smoothing is no error
    rates = seen.theta_rate
    if recording.theta_rate is None:
        rates = measured_rates(Recording(recording.name, recording.times, seen.theta))
    position, rate = nrmse(seen.theta, recording.theta), nrmse(rates, measured_rates(recording))
    return Score(recording, seen.theta, position, rate)


def nearest_simulation(simulator: Simulator, recording: Recording) -> Trajectory:
    """Simulate a run from the likeliest initial angles and rates, given what was measured.

    The fit is by Levenberg-Marquardt from the first measured row, with the sensitivities of the trajectory. Angles, and
    rates if measured, are weighted by their noise; initial rates have a prior about the derivative of the first angles.
    """
    model, n = simulator.model, recording.n_joints
    inputs = recording.inputs_for(model).later(lateness(model))
    slope = local_derivative(recording.times, recording.theta, 0, degree=2)
    free = np.zeros((simulator.equations.values.size, 2 * n))
    by_initial = np.eye(2 * n + model.n_states, 2 * n)
    with_rates = recording.theta_rate is not None
    sd = np.sqrt(np.diag(recording_noise(recording)))

    @lru_cache(maxsize=1)
    def simulated(x: tuple[float, ...]) -> Trajectory:
        start = initial_state(model, np.array(x[:n]))
        start[n : 2 * n] = x[n:]
        return simulator.run(start, recording.times, inputs, free=free, free_initial=by_initial)

    def residuals(x: Array) -> Array:
        found, prior = simulated(tuple(x)), (x[n:] - slope) / _SLOPE_SD
        if found.status is not SimulationStatus.COMPLETE:
            return np.full(recording.theta.size * (1 + with_rates) + n, _FAILED / sd[0])
        seen = as_read(model, found)
        of_angles = (seen.theta - recording.theta) / sd[:n]
        if recording.theta_rate is None:
            return np.concatenate([of_angles.ravel(), prior])
        of_rates = (seen.theta_rate - recording.theta_rate) / sd[n:]
        return np.concatenate([of_angles.ravel(), of_rates.ravel(), prior])

    def jacobian(x: Array) -> Array:
        by_states = simulated(tuple(x)).sensitivities
        parts = [by_states[:, :n] / sd[:n, None]]
        if with_rates:
            parts.append(by_states[:, n : 2 * n] / sd[n:, None])
        prior = np.eye(n, 2 * n, k=n) / _SLOPE_SD
        return np.concatenate([*(part.reshape(-1, 2 * n) for part in parts), prior])

    begin = np.concatenate([recording.theta[0], slope if recording.theta_rate is None else recording.theta_rate[0]])
    first = simulated(tuple(begin))
    if first.status is not SimulationStatus.COMPLETE:
        return first
    return simulated(tuple(least_squares(residuals, begin, jacobian, method="lm", max_nfev=_MOST).x))

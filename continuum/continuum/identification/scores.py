"""How well a model predicts runs: Eq. 19 of angles and rates, run by run (thesis Table 4 and Fig. 9).

Every run is simulated open loop from beginning to end. Its initial angles and rates, which no model knows, are those
from which the simulation comes nearest to the run.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.optimize import least_squares

from continuum.arrays import Array
from continuum.dynamics.dry_friction import with_dry_friction
from continuum.dynamics.measuring import as_read, lateness
from continuum.dynamics.model import Model
from continuum.dynamics.simulation_input import initial_state
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus, Trajectory
from continuum.identification.local_derivatives import local_derivative
from continuum.identification.nrmse import measured_rates, nrmse
from continuum.recordings.recording import Recording

_MOST = 20  # simulations; what is nearly linear needs four, and friction leaves kinks to search in for ever
_FAILED = 1e3  # rad, that a simulation which fails is off everywhere


@dataclass(frozen=True)
class Score:
    """Of one run.

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
    """Of every run."""
    simulator = Simulator(with_dry_friction(model))
    return tuple(_score(simulator, run) for run in recordings)


def _score(simulator: Simulator, recording: Recording) -> Score:
    found = nearest_simulation(simulator, recording)
    if found.status is not SimulationStatus.COMPLETE:
        return Score(recording, np.full_like(recording.theta, np.nan), np.nan, np.nan)
    seen = as_read(simulator.model, found)
    # rates that were not measured are slopes of angles: of both, so that smoothing is no error
    rates = seen.theta_rate
    if recording.theta_rate is None:
        rates = measured_rates(Recording(recording.name, recording.times, seen.theta))
    position, rate = nrmse(seen.theta, recording.theta), nrmse(rates, measured_rates(recording))
    return Score(recording, seen.theta, position, rate)


def nearest_simulation(simulator: Simulator, recording: Recording) -> Trajectory:
    """The simulation of a run from the initial angles and rates that bring it nearest to the measured angles.

    By Levenberg-Marquardt from the first measured row, with the sensitivities of the trajectory.
    """
    model, n = simulator.model, recording.n_joints
    inputs = recording.inputs_for(model).later(lateness(model))
    rates = local_derivative(recording.times, recording.theta, 0, degree=2)
    free = np.zeros((simulator.equations.values.size, 2 * n))
    by_initial = np.eye(2 * n + model.n_states, 2 * n)

    @lru_cache(maxsize=1)
    def simulated(x: tuple[float, ...]) -> Trajectory:
        start = initial_state(model, np.array(x[:n]))
        start[n : 2 * n] = x[n:]
        return simulator.run(start, recording.times, inputs, free=free, free_initial=by_initial)

    def residuals(x: Array) -> Array:
        found = simulated(tuple(x))
        if found.status is not SimulationStatus.COMPLETE:
            return np.full(recording.theta.size, _FAILED)
        return np.asarray((as_read(model, found).theta - recording.theta).ravel())

    def jacobian(x: Array) -> Array:
        return np.asarray(simulated(tuple(x)).sensitivities[:, :n].reshape(recording.theta.size, 2 * n))

    begin = np.concatenate([recording.theta[0], rates])
    first = simulated(tuple(begin))
    if first.status is not SimulationStatus.COMPLETE:
        return first
    return simulated(tuple(least_squares(residuals, begin, jacobian, method="lm", max_nfev=_MOST).x))

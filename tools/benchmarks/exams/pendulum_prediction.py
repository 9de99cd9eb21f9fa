"""Prediction of an unseen run: open-loop simulations by a model, in windows and over the whole run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize

from continuum.arrays import Array
from continuum.discovery.segment import cut
from continuum.dynamics.measuring import as_read
from continuum.dynamics.model import Model
from continuum.dynamics.simulation_input import initial_state
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus
from continuum.identification.nrmse import measured_rates, nrmse
from continuum.recordings.recording import Recording

WINDOW = 1.0  # s
_FIRST_STEP = np.radians(2.0)  # of the search for offsets: sensors zeroed by eye have errors of some degrees


@dataclass(frozen=True)
class Error:
    """Errors of simulated angles.

    Attributes:
        rms: root mean square error of each joint, (n,) [rad].
        nrmse: thesis Eq. 19.
    """

    rms: Array
    nrmse: float


@dataclass(frozen=True)
class Prediction:
    """Prediction of one run by one model.

    Attributes:
        windows: error over windows, each simulated from the measured angles and rates at its start.
        whole: error over the whole run, simulated from its first row.
        offsets: of the sensors in this run, fitted to the windows, (n,) [rad].
        windows_with_offsets, whole_with_offsets: errors with these.
    """

    windows: Error
    whole: Error
    offsets: Array
    windows_with_offsets: Error
    whole_with_offsets: Error


def predicted(model: Model, run: Recording) -> Prediction:
    """Simulate a run."""
    simulator, none = Simulator(model), np.zeros(model.n_joints)
    offsets = fitted_offsets(simulator, run)
    found = [_error(simulator, run, length, off) for off in (none, offsets) for length in (WINDOW, np.inf)]
    return Prediction(found[0], found[1], offsets, found[2], found[3])


def fitted_offsets(simulator: Simulator, run: Recording) -> Array:
    """Return the constant offset of each sensor that minimises the error over windows, (n,) [rad].

    Uses the Nelder-Mead method, because dry friction makes the error too rough for derivatives.
    """

    def square(offsets: Array) -> float:
        error = readings(simulator, run, WINDOW, offsets) - run.theta
        return float(np.mean(error**2)) if np.all(np.isfinite(error)) else np.inf

    n = simulator.model.n_joints
    begin = np.vstack([np.zeros(n), _FIRST_STEP * np.eye(n)])
    fit = minimize(
        square, np.zeros(n), method="Nelder-Mead", options={"initial_simplex": begin, "xatol": 1e-4, "fatol": 1e-9}
    )
    return np.asarray(fit.x)


def readings(simulator: Simulator, run: Recording, length: float, offsets: Array) -> Array:
    """Return simulated readings of sensors with these offsets [rad], (rows, n) [rad]; NaN where a simulation fails.

    Args:
        simulator: simulator of the model.
        run: recording; its angles minus the offsets, and its rates, start each window; states of effects start at zero.
        length: length of a window [s]; infinite for a single one.
        offsets: offsets of the sensors, (n,) [rad].
    """
    n, drive, rates = run.n_joints, run.inputs_for(simulator.model), measured_rates(run)
    found = np.full_like(run.theta, np.nan)
    for rows in cut(run.times, length):
        begin = initial_state(simulator.model, run.theta[rows.start] - offsets)
        begin[n : 2 * n] = rates[rows.start]
        motion = simulator.run(begin, run.times[rows], drive)
        if motion.status is SimulationStatus.COMPLETE:
            found[rows] = as_read(simulator.model, motion).theta + offsets
    return found


def _error(simulator: Simulator, run: Recording, length: float, offsets: Array) -> Error:
    found = readings(simulator, run, length, offsets)
    return Error(np.sqrt(np.mean((found - run.theta) ** 2, axis=0)), nrmse(found, run.theta))

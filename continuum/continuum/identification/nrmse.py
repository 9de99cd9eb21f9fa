"""Thesis Eq. 19: root mean square error over the measured standard deviation, mean over the joints."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.trajectory import Reading
from continuum.identification.local_derivatives import local_derivative
from continuum.recordings.recording import Recording


def nrmse(simulated: Array, measured: Array) -> float:
    """Return Eq. 19 of one run; joints that never move do not count.

    Args:
        simulated, measured: (n_times, n_joints), in the same unit.
    """
    return float(np.mean(nrmse_by_joint(simulated, measured)))


def nrmse_by_joint(simulated: Array, measured: Array) -> Array:
    """Return the terms of the mean, (n_moving_joints,)."""
    sd = np.std(measured, axis=0)
    moving = sd > 0
    error = np.sqrt(np.mean((simulated - measured) ** 2, axis=0))
    return np.asarray(error[moving] / sd[moving])


def position_nrmse(seen: Reading, recording: Recording) -> float:
    """Return Eq. 19 of the joint angles."""
    return nrmse(seen.theta, recording.theta)


def rate_nrmse(seen: Reading, recording: Recording) -> float:
    """Return Eq. 19 of the joint rates; if none were measured, they are derivatives of the measured angles."""
    return nrmse(seen.theta_rate, measured_rates(recording))


def measured_rates(recording: Recording) -> Array:
    """Return joint rates, (n_times, n_joints) [rad/s]: measured, or derivatives of angles by seven-sample cubics."""
    if recording.theta_rate is not None:
        return recording.theta_rate
    rows = range(recording.times.size)
    return np.stack([local_derivative(recording.times, recording.theta, row, degree=3) for row in rows])

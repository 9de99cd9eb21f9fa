"""Noise model: white noise and slow errors of the sensors, and missing torque."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.estimation.run import Run
from continuum.recordings.recording import Recording

SLOW = np.deg2rad(0.2)
"""Standard deviation of the slow error of an angle from inertial sensors [rad]."""

_QUIET = 0.06  # rad/s: a joint below this rate rests, and its third differences are noise
_ENOUGH = 50  # rows at rest to estimate the noise
_ENOUGH_PAIRS = 200  # rows to estimate the correlation of neighbours' noise
_LEAST_CORRELATION = -0.2  # closer to zero it counts as none; two joints that share a sensor have -0.5
_GAUSS = 1.4826  # standard deviation over median absolute deviation
_FLOOR = (3e-4, 1e-3)  # rad, rad/s: no encoder, sensor or picture measures a joint's angle or rate better


@dataclass(frozen=True)
class NoiseModel:
    """All that is stochastic.

    Attributes:
        white: covariance of a row's readings, (n_readings, n_readings) [rad^2, (rad/s)^2].
        slow: standard deviation of the slow error of each angle, (n,) [rad].
        slow_time: its correlation time [s].
        sigma: standard deviation of the missing torque at each joint, (n,) [N m].
        torque_time: its correlation time [s].
        start_angle, start_rate: standard deviations of the first state about the trajectory [rad, rad/s].
    """

    white: Array
    slow: Array
    sigma: Array
    slow_time: float = 1.0
    torque_time: float = 0.05
    start_angle: float = 0.1
    start_rate: float = 5.0

    def at(self, sigma: Array) -> NoiseModel:
        """Return the same with another missing torque, (n,) [N m]."""
        return replace(self, sigma=sigma)


def recording_noise(recording: Recording) -> Array:
    """Estimate the covariance of a row of one recording: of its angles and, if measured, its rates.

    Returns:
        (n, n) or (2 n, 2 n) [rad^2, (rad/s)^2].
    """
    rates = recording.theta_rate
    readings = np.ascontiguousarray(recording.theta if rates is None else np.hstack([recording.theta, rates]))
    no_inputs = (np.zeros(1), np.zeros((1, 1)))
    run = Run(recording.name, recording.times, readings, np.ones_like(readings), recording.n_joints, no_inputs)
    return white_noise([run])


def white_noise(runs: Sequence[Run]) -> Array:
    """Estimate the covariance of a row from third differences of joints at rest, (n_readings, n_readings).

    If a joint does not rest long enough, the quietest quarter of all differences counts. Joint angles that are
    differences of the same links' sensors have correlated noise; the correlation is estimated from neighbours.
    """
    n, size = runs[0].n, runs[0].readings.shape[1]
    covariance = np.zeros((size, size))
    rates = [_smooth_rates(run) for run in runs]
    for begin in range(0, size, n):
        part = slice(begin, begin + n)
        thirds, live, rests = _third_differences(runs, rates, part)
        sd = np.empty(n)
        for j in range(n):
            quiet = np.abs(thirds[rests[:, j], j])
            moving = np.abs(thirds[live[:, j], j])
            sd[j] = np.median(quiet) if quiet.size > _ENOUGH else np.quantile(moving, 0.25) / 0.47
        sd = np.maximum(np.full(n, _GAUSS * np.median(sd)), _FLOOR[begin > 0])
        x = np.clip(thirds / sd, -3, 3)
        both = rests[:, 1:] & rests[:, :-1]
        rho = float(np.mean((x[:, 1:] * x[:, :-1])[both])) if both.sum() > _ENOUGH_PAIRS else 0.0
        rho = max(rho, -0.49) if rho < _LEAST_CORRELATION else 0.0
        neighbours = np.eye(n, k=1) + np.eye(n, k=-1)
        covariance[part, part] = np.outer(sd, sd) * (np.eye(n) + rho * neighbours)
    return covariance


def white_noise_error(runs: Sequence[Run]) -> float:
    """Return the relative standard deviation of the angles' standard deviation that `white_noise` estimates.

    That of a median of N absolute normal values is 1.17 / sqrt(N). Third differences one row apart correlate by -0.75,
    two apart by 0.3: it takes 1.5 times as many. That of a median over n joints is 1.25 / sqrt(n) of a joint's.
    """
    _, live, rests = _third_differences(runs, [_smooth_rates(run) for run in runs], slice(0, runs[0].n))
    rows = np.where(rests.sum(axis=0) > _ENOUGH, rests.sum(axis=0), live.sum(axis=0))
    one = 1.17 * np.sqrt(1.5 / max(float(np.median(rows)), 1.0))
    return float(one * (1.25 / np.sqrt(runs[0].n) if runs[0].n > 2 else 1.0 / np.sqrt(runs[0].n)))


def _third_differences(
    runs: Sequence[Run], rates: Sequence[Array], part: slice
) -> tuple[Array, NDArray[np.bool_], NDArray[np.bool_]]:
    """Return third differences, scaled to one reading's noise, and whether all four rows exist and whether all rest."""
    thirds = np.concatenate([np.diff(run.readings[:, part], 3, axis=0) / np.sqrt(20) for run in runs])
    live = np.concatenate([_all_four(run.live[:, part] > 0) for run in runs])
    rests = live & np.concatenate([_all_four(np.abs(rate) < _QUIET) for rate in rates])
    return thirds, live, rests


def _smooth_rates(run: Run) -> Array:
    """Return means over nine rows of the first guess's rates, (n_times, n) [rad/s]."""
    w = run.first_guess().w
    window = np.ones(min(9, len(w))) / min(9, len(w))
    return np.stack([np.convolve(column, window, "same") for column in w.T], axis=1)


def _all_four(rows: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether something holds in four consecutive rows, (n_times - 3, n)."""
    return np.asarray(rows[:-3] & rows[1:-2] & rows[2:-1] & rows[3:])

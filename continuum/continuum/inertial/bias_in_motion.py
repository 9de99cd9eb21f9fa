"""Bias of gyroscopes on links that turn back and forth, from gravity: its direction is the same at the same angle.

A link turns about a fixed axis n, by alpha = int n . w - b dt, where b is the bias about n. Across n, with the
accelerometer's two components as one complex number z,

    z = c + d t + g exp(-i alpha) + r (i dw/dt - w^2) + noise:

gravity across the axis turns back by alpha (g), the accelerometer has a bias that drifts (c, d), and the sensor is at
a distance from the axis (r). With a wrong b, g turns away over time, which the residuals show. All but b is linear: the
residuals' sum of squares S(b) is found with the rest eliminated (variable projection: Golub, Pereyra, SIAM J. Numer.
Anal. 10, 1973). Both components have the same noise, which is white and of unknown size, so that

    log p(b) = -(m / 2) log S(b) + log p_0(b),   m = 2 n_times - 8.

The quality of the gyroscope's calibration is unknown. The prior p_0 is Gaussian about the previously known bias, with a
standard deviation s of any size between s_0 of a calibrated gyroscope and s_1 of an uncalibrated one:

    p_0(b) = int_(s_0)^(s_1) N(b; 0, s^2) ds / s  ~  (erfc(|b| / (sqrt(2) s_1)) - erfc(|b| / (sqrt(2) s_0))) / |b|.

It hardly changes a bias that gravity shows clearly, and draws one that gravity hardly shows towards zero. Mean and
standard deviation of p are the estimate and its error. No threshold decides whether gravity is of use: about an exactly
vertical axis, or for a link that hardly turns, S is flat and the prior remains.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.special import erfc

from continuum.arrays import Array
from continuum.errors import InvalidValueError, MeasurementError
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.integrated_rate import integrated

_LINEAR = 4  # complex unknowns: c, d, g, r
_CALIBRATED = EstimatorSettings.bias_left  # rad/s
_REACH = 5.0  # range of the search, in largest standard deviations of the prior
_STEP = 0.25  # rad over the whole recording, in which S(b) is smooth
_NEAR_ZERO = 60  # points on either side, closer and closer to 0, that resolve the prior
_FINER = 4, 33  # old steps on either side of the best bias, and points, of every finer grid
_ROUNDING = 1e-12  # of the sum of squares
_NONE = 1e-3 * _CALIBRATED  # rad/s, below which the prior is flat


@dataclass(frozen=True)
class BiasInMotion:
    """Biases (n, 3) [rad/s], and standard deviations of their components about the axes (n,) [rad/s]."""

    bias: Array
    error: Array


def bias_in_motion(recording: ImuRecording, axis: Array, prior: Array, uncertainty: float) -> BiasInMotion:
    """Return the prior biases, with the component about each axis replaced by its posterior mean.

    Args:
        recording: recording of links that turn about their axes, past the same angles at different times.
        axis: unit vectors in each sensor's axes, (n, 3).
        prior: biases from rest or from the vendor, (n, 3) [rad/s].
        uncertainty: largest standard deviation of the biases from ``prior`` in the recording [rad/s].

    Raises:
        InvalidValueError: ``uncertainty`` is not above 0.01 degrees/s, which is that of a calibrated sensor.
        MeasurementError: a sensor has too few readings for the unknowns.
    """
    if not _CALIBRATED < uncertainty < np.inf:
        raise InvalidValueError("uncertainty of the bias", uncertainty, f"more than {_CALIBRATED:.2g} rad/s")
    found = []
    for sensor in range(recording.n_sensors):
        good = recording.good[:, sensor]
        if np.count_nonzero(good) <= _LINEAR:
            raise MeasurementError(f"sensor {sensor + 1} has only {np.count_nonzero(good)} good readings")
        n = axis[sensor]
        rate = (recording.rates[good, sensor] - prior[sensor]) @ n
        log_likelihood = _log_likelihood(recording.times[good], rate, recording.forces[good, sensor], n)
        found.append(_posterior(log_likelihood, uncertainty, float(np.ptp(recording.times[good]))))
    mean, error = np.array(found).T
    return BiasInMotion(prior + axis * mean[:, None], error)


def _log_likelihood(times: Array, rate: Array, forces: Array, axis: Array) -> Callable[[float], float]:
    """Return the log-likelihood of the remaining bias about the axis [rad/s], up to a constant."""
    across = np.linalg.svd(axis[None])[2][1]
    z = forces @ across + 1j * (forces @ np.cross(axis, across))
    t, alpha = times - times.mean(), integrated(times, rate[:, None])[:, 0]
    lever = 1j * np.gradient(rate, times) - rate**2
    q = np.linalg.qr(np.stack([np.ones_like(z), t, lever], axis=1))[0]
    z = z - q @ (q.conj().T @ z)
    whole, m = float(np.vdot(z, z).real), 2 * (t.size - _LINEAR)
    least = max(_ROUNDING * whole, np.finfo(float).tiny)

    def log_likelihood(bias: float) -> float:
        turning = np.exp(-1j * (alpha - bias * t))
        turning -= q @ (q.conj().T @ turning)
        size = float(np.vdot(turning, turning).real)
        seen = abs(np.vdot(turning, z)) ** 2 / size if size > _ROUNDING * t.size else 0.0
        return -m / 2 * float(np.log(max(whole - seen, least)))

    return log_likelihood


def _posterior(log_likelihood: Callable[[float], float], uncertainty: float, duration: float) -> tuple[float, float]:
    """Return mean and standard deviation [rad/s], by sums on a grid that is refined until it resolves the latter."""
    reach = _REACH * uncertainty
    even = np.linspace(-reach, reach, 2 * int(np.ceil(reach * duration / _STEP)) + 1)
    near = np.geomspace(_CALIBRATED / 4, reach, _NEAR_ZERO)
    grid = np.unique(np.concatenate([even, near, -near]))
    while True:
        logs = np.array([log_likelihood(bias) for bias in grid]) + _log_prior(grid, uncertainty)
        steps = np.gradient(grid)
        weights = np.exp(logs - logs.max()) * steps
        weights /= weights.sum()
        mean = float(weights @ grid)
        error = float(np.sqrt(weights @ (grid - mean) ** 2))
        best = np.argmax(logs)
        if error > steps[best]:
            return mean, error
        away = _FINER[0] * steps[best]
        grid = np.linspace(grid[best] - away, grid[best] + away, _FINER[1])


def _log_prior(bias: Array, uncertainty: float) -> Array:
    """Return the log-prior of biases (k,), up to a constant."""
    size = np.maximum(np.abs(bias), _NONE) / np.sqrt(2)
    return np.asarray(np.log(erfc(size / uncertainty) - erfc(size / _CALIBRATED)) - np.log(size))

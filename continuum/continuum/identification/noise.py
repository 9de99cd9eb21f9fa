"""How much the sensors err, estimated from the recordings without any model of the arm.

White noise is what remains of fourth differences: motion sampled at 120 Hz leaves next to nothing in them. What wanders
slowly in the angles is seen beside the integral of the measured rates. Joints are differences of neighbouring
sensors, so their errors are correlated from joint to joint; the covariance over the joints is estimated too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from continuum.arrays import Array
from continuum.identification.recording import Recording

_ANGLE_FLOOR = np.deg2rad(0.1)  # no joint angle from inertial sensors is better [rad]
_RATE_FLOOR = np.deg2rad(0.1)  # [rad/s]
_WANDER_TRIED = np.concatenate([[0.0], np.geomspace(0.05, 30, 25)])  # sizes in units of the white noise


@dataclass(frozen=True)
class SensorKnowledge:
    """What is known of the sensors beforehand.

    Attributes:
        wander: standard deviation of the angles' slow error, where rates do not tell it [rad].
        wander_time: how long that error stays alike [s].
        rate_bias: standard deviation of the rates' constant error after calibration [rad/s].
    """

    wander: float = np.deg2rad(0.2)
    wander_time: float = 1.0
    rate_bias: float = np.deg2rad(0.15)


@dataclass(frozen=True)
class Channel:
    """Error of one kind of sensor: covariance over the joints, times unit white noise and a slow part in time.

    Attributes:
        joints: (n_joints, n_joints) [rad^2 or rad^2/s^2].
        slow: variance of the slow part in units of the white one.
        slow_time: correlation time of the slow part, infinite for a constant [s].
    """

    joints: Array
    slow: float
    slow_time: float

    def whitener(self, times: Array) -> Whitener:
        """What turns errors sampled at ``times`` into independent ones of unit variance."""
        apart = np.abs(times[:, None] - times[None, :])
        in_time = np.eye(times.size) + self.slow * np.exp(-apart / self.slow_time)
        return Whitener(np.linalg.cholesky(in_time), np.linalg.cholesky(self.joints))

    @property
    def white(self) -> Array:
        """Standard deviation of the white part at each joint, (n_joints,) [rad or rad/s]."""
        return np.sqrt(np.diag(self.joints))


@dataclass(frozen=True)
class Whitener:
    """Cholesky factors of the covariance in time and over the joints."""

    in_time: Array
    over_joints: Array

    def __call__(self, errors: Array) -> Array:
        """Errors (n_times, n_joints, ...) made independent, same shape [1]."""
        flat = errors.reshape(errors.shape[0], -1)
        by_time = solve_triangular(self.in_time, flat, lower=True).reshape(errors.shape)
        return np.einsum("ij,tj...->ti...", np.linalg.inv(self.over_joints), by_time)


@dataclass(frozen=True)
class Noise:
    """Errors of the angles, and of the rates where they are measured."""

    angle: Channel
    rate: Channel | None


def estimate_noise(recordings: Sequence[Recording], known: SensorKnowledge | None = None) -> Noise:
    """Noise of the sensors, common to all recordings."""
    known = known or SensorKnowledge()
    white = _white_covariance([r.theta for r in recordings], _ANGLE_FLOOR)
    scale = float(np.mean(np.diag(white)))
    rates = [r.theta_rate for r in recordings if r.theta_rate is not None]
    if len(rates) < len(recordings):
        return Noise(Channel(white, known.wander**2 / scale, known.wander_time), None)
    rate_white = _white_covariance(rates, _RATE_FLOOR)
    wander = _wander(recordings, white, rate_white, known.wander_time)
    bias = known.rate_bias**2 / float(np.mean(np.diag(rate_white)))
    return Noise(Channel(white, wander**2, known.wander_time), Channel(rate_white, bias, np.inf))


def _white_covariance(signals: Sequence[Array], floor: float) -> Array:
    """Covariance over the joints of the white part, (n, n), from fourth differences; outliers are held down."""
    differences = np.concatenate([np.diff(signal, 4, axis=0) for signal in signals]) / np.sqrt(70)
    spread = 1.4826 * np.median(np.abs(differences), axis=0)
    held = np.clip(differences, -3 * spread, 3 * spread)
    correlation = np.corrcoef(held.T) if held.shape[1] > 1 and np.all(spread > 0) else np.eye(held.shape[1])
    spread = np.maximum(spread, floor)
    return np.asarray(0.95 * correlation + 0.05 * np.eye(spread.size)) * np.outer(spread, spread)


def _wander(recordings: Sequence[Recording], white: Array, rate_white: Array, time: float) -> float:
    """Size of the angles' slow part in units of the white one: the likeliest, given the rates."""
    score = np.zeros(_WANDER_TRIED.size)
    for recording in recordings:
        t, rate = recording.times - recording.times[0], recording.theta_rate
        if rate is None:
            continue
        dt = np.diff(t)
        integral = np.concatenate(
            [np.zeros((1, rate.shape[1])), np.cumsum((rate[1:] + rate[:-1]) / 2 * dt[:, None], 0)]
        )
        away = np.stack([np.ones(t.size), t], axis=1)  # an angle's start and a rate's bias are no wander
        basis = np.linalg.qr(np.column_stack([away, np.eye(t.size)[:, : t.size - 2]]))[0][:, 2:]
        gap = (basis.T @ (recording.theta - integral)) / np.sqrt(np.diag(white))
        walk = float(np.mean(np.diag(rate_white) / np.diag(white)) * np.mean(dt)) * np.minimum(t[:, None], t[None, :])
        slow = basis.T @ np.exp(-np.abs(t[:, None] - t[None, :]) / time) @ basis
        rest = np.eye(basis.shape[1]) + basis.T @ walk @ basis
        for k, size in enumerate(_WANDER_TRIED):
            factor = np.linalg.cholesky(rest + size**2 * slow)
            score[k] -= gap.shape[1] * np.log(np.diag(factor)).sum()
            score[k] -= (solve_triangular(factor, gap, lower=True) ** 2).sum() / 2
    return float(_WANDER_TRIED[np.argmax(score)])

"""How much the sensors err, estimated from the recordings without any model of the arm.

White noise is what remains of fourth differences where the arm is quiet. What wanders
slowly in the angles is seen beside the integral of the measured rates. Joints are differences of neighbouring
sensors, so their errors are correlated from joint to joint; the covariance over the joints is estimated too.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import gamma

from continuum.arrays import Array
from continuum.recordings.recording import Recording

_RATE_FLOOR = np.deg2rad(0.1)  # no rate of a joint, which two gyros measure, is better [rad/s]
_SIMULATED_RATE = np.deg2rad(0.5)  # what another slope of smoothed dry friction changes in a simulated rate [rad/s]
_STRETCH = 16  # samples
_LONGEST = 240  # samples in which the wander is looked for at once
_SHAPE = 3.1  # of the gamma distribution of white noise's mean square in a stretch, measured on white noise
_QUIETEST, _LOUDER = 3, 2.0  # stretches, and by how much noise's variance is more: the search begins there
_STILL = 2.2  # times the variance of noise: a stretch of less holds noise alone
_FEWEST = 4  # stretches for a correlation
_WANDER_TRIED = np.concatenate([[0.0], np.geomspace(0.05, 30, 25)])  # sizes in units of the white noise


@dataclass(frozen=True)
class SensorKnowledge:
    """What is known of the sensors beforehand.

    Attributes:
        wander: standard deviation of the angles' slow error, where rates do not tell it [rad].
        wander_time: how long that error stays alike [s].
        rate_bias: standard deviation of the rates' constant error after calibration [rad/s].
        angle_floor: standard deviation of white noise, than which no joint angle from inertial sensors is better [rad].
    """

    wander: float = np.deg2rad(0.2)
    wander_time: float = 1.0
    rate_bias: float = np.deg2rad(0.15)
    angle_floor: float = np.deg2rad(0.1)


@dataclass(frozen=True)
class Channel:
    """Error of one kind of sensor: covariance over the joints, times unit white noise and a slow part in time.

    Attributes:
        joints: (n_joints, n_joints) [rad^2 or rad^2/s^2].
        slow: variance of the slow part in units of the white one.
        slow_time: correlation time of the slow part, infinite for a constant [s].
        walk: variance that a random walk gains in a second, in units of the white one [1/s].
        ramp: variance of a slope in time, in units of the white part's [1/s2].
    """

    joints: Array
    slow: float
    slow_time: float
    walk: float = 0.0
    ramp: float = 0.0

    def in_time(self, times: Array) -> Array:
        """Covariance of the errors sampled at ``times``, in units of the white part, (n_times, n_times)."""
        apart, since = np.abs(times[:, None] - times[None, :]), times - times[0]
        walk = self.walk * np.minimum(since[:, None], since[None, :])
        slow = self.slow * np.exp(-apart / self.slow_time)
        return np.asarray(np.eye(times.size) + slow + walk + self.ramp * np.outer(since, since))

    @property
    def white(self) -> Array:
        """Standard deviation of the white part at each joint, (n_joints,) [rad or rad/s]."""
        return np.sqrt(np.diag(self.joints))


@dataclass(frozen=True)
class Noise:
    """Errors of the angles, and of the rates where they are measured.

    Attributes:
        angle, rate: of the sensors.
        is_simulated: whether the rates are quieter than any sensor's: then they err as those of simulations do.
    """

    angle: Channel
    rate: Channel | None
    is_simulated: bool = False


def estimate_noise(recordings: Sequence[Recording], known: SensorKnowledge | None = None) -> Noise:
    """Noise of the sensors, common to all recordings."""
    known = known or SensorKnowledge()
    white = _white_covariance([r.theta for r in recordings], known.angle_floor)
    scale = float(np.mean(np.diag(white)))
    rates = [r.theta_rate for r in recordings if r.theta_rate is not None]
    if len(rates) < len(recordings):
        return Noise(Channel(white, known.wander**2 / scale, known.wander_time), None)
    is_simulated = bool(np.all(_white_levels(rates) < _RATE_FLOOR))
    rate_white = _white_covariance(rates, _SIMULATED_RATE if is_simulated else _RATE_FLOOR)
    wander = _wander(recordings, white, rate_white, known.wander_time)
    bias = known.rate_bias**2
    # angles of gyros are integrals of what the rates show: their noise adds up to a walk, their bias to a ramp
    step = float(np.mean(np.concatenate([np.diff(r.times) for r in recordings])))
    walk = float(np.mean(np.diag(rate_white))) * step
    return Noise(
        Channel(white, wander**2, known.wander_time, walk / scale, bias / scale),
        Channel(rate_white, bias / float(np.mean(np.diag(rate_white))), np.inf),
        is_simulated,
    )


def _white_covariance(signals: Sequence[Array], floor: float) -> Array:
    """Covariance over the joints of the white part, (n, n), from fourth differences in the quietest stretches.

    Links that swing fast against each other after a release show in fourth differences too, so that only stretches in
    which they are least are believed; white noise itself would be least somewhere, which the factor takes back.
    """
    n = signals[0].shape[1]
    stretches = _stretches(signals)
    energy = _energy(stretches)
    spread: Array = np.maximum(_white_levels(signals), floor)
    loudest = np.max(energy / spread**2, axis=1)
    limit = max(_STILL, np.sort(loudest)[min(_FEWEST, loudest.size) - 1])
    quiet = [piece for piece, size in zip(stretches, loudest, strict=True) if size <= limit]
    correlation: Array = np.eye(n)
    if n > 1 and len(quiet) >= _FEWEST:
        parts = np.concatenate(quiet)
        if np.all(np.std(parts, axis=0) > 1e-9):  # angles read off a picture may stand quite still
            correlation = np.asarray(
                np.corrcoef(np.clip(parts, -3 * np.std(parts, axis=0), 3 * np.std(parts, axis=0)).T)
            )
    return np.asarray(0.95 * correlation + 0.05 * np.eye(n)) * np.outer(spread, spread)


def _stretches(signals: Sequence[Array]) -> list[Array]:
    """Fourth differences of short stretches, each (n_times, n)."""
    return [
        piece
        for signal in signals
        for piece in np.array_split(np.diff(signal, 4, axis=0), max(1, signal.shape[0] // _STRETCH))
    ]


def _energy(stretches: Sequence[Array]) -> Array:
    """Variance that white noise would have to give these differences, (n_stretches, n)."""
    return np.array([np.mean(piece**2, axis=0) / 70 for piece in stretches])


def _white_levels(signals: Sequence[Array]) -> Array:
    """Standard deviation of the white part of each joint, (n,)."""
    return np.sqrt([_quiet_variance(joint) for joint in _energy(_stretches(signals)).T])


def _quiet_variance(energy: Array) -> float:
    """Variance of the white part, from the mean squares of stretches, (n_stretches,), of which most may hold motion.

    It is that of the quietest, and of all that are as quiet as noise of that variance would be, and so on.
    """
    rising = np.sort(energy)
    kept = gamma.cdf(_STILL, _SHAPE + 1, scale=1 / _SHAPE) / gamma.cdf(_STILL, _SHAPE, scale=1 / _SHAPE)
    count, variance = 0, _LOUDER * float(np.mean(rising[:_QUIETEST]))
    while (within := max(_QUIETEST, int(np.searchsorted(rising, _STILL * variance)))) > count:
        count, variance = within, float(np.mean(rising[:within])) / kept
    return variance


def _wander(recordings: Sequence[Recording], white: Array, rate_white: Array, time: float) -> float:
    """Size of the angles' slow part in units of the white one: the likeliest, given the rates."""
    score = np.zeros((2, _WANDER_TRIED.size))  # angles that are integrals of these rates, and angles of their own
    share = float(np.mean(np.diag(rate_white) / np.diag(white)))
    for recording in recordings:
        if recording.theta_rate is None:
            continue
        for first in range(0, recording.times.size - _LONGEST // 2, _LONGEST):
            rows = slice(first, first + _LONGEST)
            gap = recording.theta[rows] - _integral(recording.times[rows], recording.theta_rate[rows])
            score += _wander_score(recording.times[rows], gap / np.sqrt(np.diag(white)), share, time)
    return float(_WANDER_TRIED[np.argmax(score.max(axis=0))])


def _integral(times: Array, rate: Array) -> Array:
    """Of the rates from the first sample on, (n_times, n_joints) [rad]."""
    steps = (rate[1:] + rate[:-1]) / 2 * np.diff(times)[:, None]
    return np.concatenate([np.zeros((1, rate.shape[1])), np.cumsum(steps, axis=0)])


def _wander_score(times: Array, gap: Array, share: float, time: float) -> Array:
    """Log-likelihood of each size that is tried, (2, n_sizes), if the gap holds no walk of the rates, and if it does.

    In coordinates in which both white and slow part are independent, each size costs next to nothing.
    """
    t = times - times[0]
    away = np.stack([np.ones(t.size), t], axis=1)  # an angle's start and a rate's bias are no wander
    basis = np.linalg.qr(np.column_stack([away, np.eye(t.size)[:, : t.size - 2]]))[0][:, 2:]
    gap = basis.T @ gap
    slow = basis.T @ np.exp(-np.abs(t[:, None] - t[None, :]) / time) @ basis
    walk = share * float(np.mean(np.diff(t))) * (basis.T @ np.minimum(t[:, None], t[None, :]) @ basis)
    scores = []
    for rest in (np.eye(slow.shape[0]), np.eye(slow.shape[0]) + walk):
        factor = np.linalg.cholesky(rest)
        sizes, vectors = np.linalg.eigh(np.linalg.solve(factor, np.linalg.solve(factor, slow).T))
        energy = ((vectors.T @ np.linalg.solve(factor, gap)) ** 2).sum(axis=1)
        spread = 1 + _WANDER_TRIED[:, None] ** 2 * np.maximum(sizes, 0.0)
        fixed = gap.shape[1] * np.log(np.diag(factor)).sum()
        scores.append(-(gap.shape[1] * np.log(spread) + energy / spread).sum(axis=1) / 2 - fixed)
    return np.array(scores)

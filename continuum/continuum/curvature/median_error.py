"""Covariances of the errors of holds' medians from the true joint angles.

    median - true angle = e + b + w(t) + d t

e is white noise: medians of n rows of standard deviations s_i and correlation rho have the covariance
s_i s_j arcsin(rho) / n, of one joint pi s^2 / (2 n). b is the slow error of each joint's
sensor, the same in all holds of a recording, with standard deviation SLOW. From the start of the recording, w wanders
and d t drifts, as integrated rates do: w is a random walk of variance q t, d the remaining bias of a gyroscope. Holds
show both, as the true angle does not change in them. From one window of T = 0.5 s with n rows to the next, the mean
angle changes by d T on average, with variance 2 q T / 3 + 2 C / n. Adjacent holds, separate only because the angles
wander by more than a hold may, count as one.

Errors b, w and d of different joints are assumed independent. If neighbouring joints share a sensor, their errors have
opposite signs, and a difference between base and tip is more certain than these covariances say.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.curvature.holds import Hold
from continuum.estimation.sensor_noise import SLOW
from continuum.inertial.stillness import SHORTEST_REST

_WINDOW = SHORTEST_REST / 2
"""Length of the windows whose changes show the wander [s]; the shortest hold has two."""

_TELLING = 4
"""Least number of changes for both a mean and a variance: the relative error of the variance is then below 1."""


@dataclass(frozen=True)
class MedianErrors:
    """Covariance of the errors of holds h and k: ``diag(shared[h, k])``, and ``white[h]`` where these are the same.

    Attributes:
        white: (n_holds, n, n) [rad^2].
        shared: (n_holds, n_holds, n) [rad^2].
    """

    white: Array
    shared: Array

    def covariance(self, hold: int) -> Array:
        """Return the covariance of one hold's medians, (n, n) [rad^2]."""
        white = self.white[hold]
        return np.asarray(white + np.diag(self.shared[hold, hold]))

    def variance(self, derivatives: Array) -> float:
        """Return the variance of a function of all medians, given its derivatives, (n_holds, n) [./rad]."""
        by_white = np.einsum("hi,hij,hj", derivatives, self.white, derivatives)
        return float(by_white + np.einsum("hi,hki,ki", derivatives, self.shared, derivatives))


def median_errors(holds: Sequence[Hold], slow: float | None = None) -> MedianErrors:
    """Return the errors of the medians of holds, of one recording or several.

    Args:
        holds: one or more holds.
        slow: standard deviation of all errors that are not white, if known [rad]; if None, SLOW, wander and drift.
    """
    white = np.stack([_median_covariance(hold.noise) / len(hold.times) for hold in holds])
    recordings = [id(hold.recording) for hold in holds]
    same = np.equal.outer(recordings, recordings)[:, :, None]
    n = len(holds[0].theta)
    if slow is not None:
        return MedianErrors(white, same * np.full(n, slow**2))
    since = np.array([hold.since_begin for hold in holds])
    found = {one: _wander_and_drift([h for h in holds if id(h.recording) == one]) for one in recordings}
    wandered = np.minimum.outer(since, since) * np.array([found[one][0] for one in recordings])
    drifted = np.multiply.outer(since, since)[:, :, None] * np.array([found[one][1] for one in recordings])
    return MedianErrors(white, same * (SLOW**2 + wandered[:, :, None] + drifted))


def _median_covariance(noise: Array) -> Array:
    """Return n times the covariance of medians of n rows of normal noise of covariance ``noise``, (n, n) [rad^2].

    Medians err together as often as the rows lie on the same side: with the orthant probability of two normal values,
    1/4 + arcsin(rho) / (2 pi).
    """
    deviations = np.sqrt(np.diag(noise))
    both = np.outer(deviations, deviations)
    correlation = np.divide(noise, both, out=np.zeros_like(noise), where=both > 0)
    return np.asarray(both * np.arcsin(np.clip(correlation, -1.0, 1.0)))


def _wander_and_drift(holds: Sequence[Hold]) -> tuple[float, Array]:
    """Return q of one recording, a mean over joints [rad^2/s], and d^2 of each joint, (n,) [(rad/s)^2].

    Each is 0 if below the effect of the other errors. Too few changes cannot separate drift from wander; d is then 0.
    """
    changes, noise = zip(*(_changes(holds[0], rows) for rows in _joined(holds)), strict=True)
    moved, by_noise = np.concatenate(changes), np.concatenate(noise)
    k, n = moved.shape
    if k == 0:
        return 0.0, np.zeros(n)
    mean = moved.mean(axis=0) if k >= _TELLING else np.zeros(n)
    about = np.sum((moved - mean) ** 2, axis=0) / (k - 1 if k >= _TELLING else k)
    q = max(float(np.mean(about - by_noise.mean(axis=0))), 0.0) / (2 / 3 * _WINDOW)
    drift = mean / _WINDOW
    by_chance = (q * _WINDOW * k + by_noise.mean(axis=0) * len(changes)) / (k * _WINDOW) ** 2
    return q, np.maximum(drift**2 - by_chance, 0.0)


def _changes(hold: Hold, rows: slice) -> tuple[Array, Array]:
    """Return the changes of the mean angles from window to window, (k, n) [rad], and their variances by white noise."""
    times, theta = hold.recording.times[rows], hold.recording.theta[rows]
    first = np.flatnonzero(np.diff(np.floor((times - times[0]) / _WINDOW), prepend=-1.0))
    counts = np.diff(first)[:, None]  # without the last one, which may be shorter
    means = np.add.reduceat(theta[: first[-1]], first[:-1], axis=0) / counts if first.size > 1 else theta[:0]
    if len(means) < 2:
        return theta[:0], theta[:0]
    return np.diff(means, axis=0), np.diag(hold.noise) * (1 / counts[1:] + 1 / counts[:-1])


def _joined(holds: Sequence[Hold]) -> list[slice]:
    """Return the rows of holds, with adjacent ones joined."""
    joined: list[slice] = []
    for hold in sorted(holds, key=lambda one: one.rows.start):
        if joined and joined[-1].stop == hold.rows.start:
            joined[-1] = slice(joined[-1].start, hold.rows.stop)
        else:
            joined.append(hold.rows)
    return joined

"""How far the medians of holds may be from the true joint angles: covariances of their errors.

    median - true angle = e + b + w(t)

e is white noise: a median of n rows of covariance C has pi C / (2 n). b is the slow error of each joint's sensor, one
for all holds of a recording, of standard deviation SLOW. w wanders since the recording began, as integrated rates do:
a random walk of variance q t. What shows q are the holds, in which the true angle does not change: from one T = 0.5 s
to the next, of n rows each, the mean angle changes by variance 2 q T / 3 + 2 C / n. Holds that follow each other at
once, because the angles wander by more than a hold may, count as one.

Errors b and w of different joints are taken as independent. Where neighbouring joints share a sensor, their errors
oppose each other, and a difference between base and tip is more certain than these covariances say.
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
"""From which to the next the wander is seen [s]; the shortest hold has two."""


@dataclass(frozen=True)
class MedianErrors:
    """Covariance of the errors of holds h and k: ``shared[h, k] * I``, and ``white[h]`` where these are the same.

    Attributes:
        white: (n_holds, n, n) [rad^2].
        shared: (n_holds, n_holds) [rad^2].
    """

    white: Array
    shared: Array

    def covariance(self, hold: int) -> Array:
        """Of one hold's medians, (n, n) [rad^2]."""
        white = self.white[hold]
        return np.asarray(white + self.shared[hold, hold] * np.eye(len(white)))

    def variance(self, derivatives: Array) -> float:
        """Variance of a function of all medians by its slopes, (n_holds, n) [./rad]."""
        by_white = np.einsum("hi,hij,hj", derivatives, self.white, derivatives)
        return float(by_white + np.sum(self.shared * (derivatives @ derivatives.T)))


def median_errors(holds: Sequence[Hold], slow: float | None = None) -> MedianErrors:
    """Errors of the medians of holds, those of several recordings among them.

    Args:
        holds: one or more.
        slow: standard deviation of all that is not white, where it is known [rad]; without, SLOW and what wanders.
    """
    white = np.stack([np.pi / 2 * hold.noise / len(hold.times) for hold in holds])
    recordings = [id(hold.recording) for hold in holds]
    same = np.equal.outer(recordings, recordings)
    if slow is not None:
        return MedianErrors(white, same * slow**2)
    since = np.array([hold.since_begin for hold in holds])
    rate = {one: _wander([h for h in holds if id(h.recording) == one]) for one in recordings}
    wandered = np.minimum.outer(since, since) * np.array([rate[one] for one in recordings])
    return MedianErrors(white, same * (SLOW**2 + wandered))


def _wander(holds: Sequence[Hold]) -> float:
    """q of one recording, a mean over joints and holds [rad^2/s]; 0 where it is less than what white noise makes."""
    excess, seconds = 0.0, 0.0
    for rows in _joined(holds):
        times, theta = holds[0].recording.times[rows], holds[0].recording.theta[rows]
        first = np.flatnonzero(np.diff(np.floor((times - times[0]) / _WINDOW), prepend=-1.0))
        counts = np.diff(first)[:, None]  # the last one, which may be shorter, is left out
        means = np.add.reduceat(theta[: first[-1]], first[:-1], axis=0) / counts if first.size > 1 else theta[:0]
        by_noise = np.diag(holds[0].noise) * (1 / counts[1:] + 1 / counts[:-1])
        excess += float(np.sum(np.mean(np.diff(means, axis=0) ** 2 - by_noise, axis=1)))
        seconds += 2 / 3 * _WINDOW * max(len(means) - 1, 0)
    return max(excess / seconds, 0.0) if seconds > 0 else 0.0


def _joined(holds: Sequence[Hold]) -> list[slice]:
    """Rows of holds, those that follow each other at once as one."""
    joined: list[slice] = []
    for hold in sorted(holds, key=lambda one: one.rows.start):
        if joined and joined[-1].stop == hold.rows.start:
            joined[-1] = slice(joined[-1].start, hold.rows.stop)
        else:
            joined.append(hold.rows)
    return joined

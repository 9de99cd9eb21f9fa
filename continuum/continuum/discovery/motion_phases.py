"""When a simulation goes wrong: error of free runs by joint and by what the joint is doing."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter1d

from continuum.arrays import Array
from continuum.discovery.measured_gain import RunScore
from continuum.identification.nrmse import measured_rates
from continuum.recordings.recording import Recording

PHASES = ("at rest", "turning back", "speeding up", "slowing down")

_SLOW = 0.1  # rad/s; a joint that is slower rests, unless it turns back
_TURNING = 0.1  # s around the instant at which a joint turns back; one that is slow for longer has rested
_SMOOTH = 0.04  # s


def phases(recording: Recording) -> NDArray[np.intp]:
    """Which of PHASES every joint is in, (n_times, n_joints)."""
    times = recording.times
    samples = max(1, round(_SMOOTH / float(np.median(np.diff(times)))))
    rate = uniform_filter1d(measured_rates(recording), samples, axis=0, mode="nearest")
    faster = np.gradient(np.abs(rate), times, axis=0) > 0
    found = np.where(faster, PHASES.index("speeding up"), PHASES.index("slowing down"))
    found[np.abs(rate) < _SLOW] = PHASES.index("at rest")
    for joint in range(rate.shape[1]):
        moving = np.flatnonzero(np.abs(rate[:, joint]) >= _SLOW)
        for before, after in pairwise(moving):
            if rate[before, joint] * rate[after, joint] < 0 and times[after] - times[before] < _TURNING:
                middle = (times[before] + times[after]) / 2
                found[np.abs(times - middle) <= _TURNING / 2, joint] = PHASES.index("turning back")
    return np.asarray(found)


def errors_by_phase(scores: Sequence[RunScore], others: Sequence[RunScore]) -> tuple[Array, Array]:
    """Root mean square error of two models' free runs, (n_phases, n_joints) [rad]; NaN where no joint did so.

    Args:
        scores, others: of the same runs, each by another model; those that not both can simulate do not count.
    """
    both = [(one, other) for one, other in zip(scores, others, strict=True) if one.seen and other.seen]
    now = [phases(one.recording) for one, _ in both]
    n = scores[0].recording.n_joints
    return _errors([one for one, _ in both], now, n), _errors([other for _, other in both], now, n)


def _errors(scores: Sequence[RunScore], now: Sequence[NDArray[np.intp]], n_joints: int) -> Array:
    found = np.full((len(PHASES), n_joints), np.nan)
    errors = [score.seen.theta - score.recording.theta for score in scores if score.seen]
    for phase in range(len(PHASES)):
        for joint in range(n_joints):
            there = [error[at[:, joint] == phase, joint] for error, at in zip(errors, now, strict=True)]
            if any(error.size for error in there):
                found[phase, joint] = np.sqrt(np.mean(np.concatenate(there) ** 2))
    return found

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
from continuum.identification.recording import Recording

PHASES = ("at rest", "turning back", "speeding up", "slowing down")

_SLOW = 0.1  # rad/s; a joint that is slower rests, or turns back
_TURNING = 0.1  # s; a joint that is slow for longer between two ways has rested
_SMOOTH = 5  # samples


def phases(recording: Recording) -> NDArray[np.intp]:
    """Which of PHASES every joint is in, (n_times, n_joints)."""
    rate = uniform_filter1d(measured_rates(recording), _SMOOTH, axis=0, mode="nearest")
    faster = np.gradient(np.abs(rate), recording.times, axis=0) > 0
    found = np.where(faster, PHASES.index("speeding up"), PHASES.index("slowing down"))
    for joint in range(rate.shape[1]):
        way = np.where(np.abs(rate[:, joint]) < _SLOW, 0.0, np.sign(rate[:, joint]))
        edges = np.concatenate([[0], np.flatnonzero(np.diff(way)) + 1, [way.size]])
        for first, after in pairwise(edges):
            if way[first] == 0.0:
                inside = first > 0 and after < way.size
                is_turn = inside and way[first - 1] == -way[after]
                is_short = recording.times[after - 1] - recording.times[first] < _TURNING
                found[first:after, joint] = PHASES.index("turning back" if is_turn and is_short else "at rest")
    return np.asarray(found)


def errors_by_phase(scores: Sequence[RunScore]) -> Array:
    """Root mean square error of free runs, (n_phases, n_joints) [rad]; NaN where no joint did so.

    Args:
        scores: of the runs; those that could not be simulated do not count.
    """
    seen = [(score.seen.theta - score.recording.theta, phases(score.recording)) for score in scores if score.seen]
    n = scores[0].recording.n_joints
    found = np.full((len(PHASES), n), np.nan)
    for phase in range(len(PHASES)):
        for joint in range(n):
            errors = [error[now[:, joint] == phase, joint] for error, now in seen]
            if any(error.size for error in errors):
                found[phase, joint] = np.sqrt(np.mean(np.concatenate(errors) ** 2))
    return found

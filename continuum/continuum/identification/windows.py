"""Runs cut into short windows, each begun from a state of its own (multiple shooting, Bock and Plitt 1984).

An arm that sticks and slips forgets nothing: a parameter wrong by a hundredth soon makes one joint stick that should
slip, and from there on a free run tells as little about the parameter as chance. Over a tenth of a second the same
model is nearly linear in its parameters, and still every torque shows: links are light, sensors see what they do in a
few samples.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from continuum.arrays import Array
from continuum.identification.noise import Channel, Noise
from continuum.recordings.recording import Recording

WITH_RATES, WITHOUT_RATES = 0.1, 0.15  # usual length of a window, by what was measured [s]


def window_rows(recording: Recording, length: float | None) -> list[slice]:
    """Rows of each window, all rows in one where no length is given.

    Args:
        recording: what was measured.
        length: of a window [s].
    """
    n = recording.times.size
    if length is None:
        return [slice(0, n)]
    span = recording.times[-1] - recording.times[0]
    pieces = max(1, min(round(span / length), n // 4))
    edges = np.searchsorted(recording.times, np.linspace(recording.times[0], recording.times[-1], pieces + 1))
    edges[-1] = n
    return [slice(int(a), int(b)) for a, b in pairwise(edges) if b - a > 1]


def usual_length(recording: Recording) -> float:
    """Length of a window [s]: longer where rates were not measured and take time to show."""
    return WITHOUT_RATES if recording.theta_rate is None else WITH_RATES


@dataclass(frozen=True)
class Whitener:
    """Makes the errors of one window independent and of unit variance.

    Attributes:
        angle_in_time, rate_in_time: inverse Cholesky factors of the covariance in time, (n_times, n_times); no rates
            where none were measured.
        angle_joints, rate_joints: the same over the joints, (n_joints, n_joints).
    """

    angle_in_time: Array
    angle_joints: Array
    rate_in_time: Array | None
    rate_joints: Array | None

    def __call__(self, angle: Array, rate: Array) -> Array:
        """Errors or slopes of angles and rates, (n_times, n_joints, ...) [rad, rad/s], as one array (m, ...)."""
        parts = [_whitened(angle, self.angle_in_time, self.angle_joints)]
        if self.rate_in_time is not None and self.rate_joints is not None:
            parts.append(_whitened(rate, self.rate_in_time, self.rate_joints))
        return np.concatenate([part.reshape(-1, *angle.shape[2:]) for part in parts])


def whitener(noise: Noise, recording: Recording, rows: slice) -> Whitener:
    """Of one window."""
    times = recording.times[rows]
    angle = _factors(noise.angle, times)
    rate = (None, None) if noise.rate is None or recording.theta_rate is None else _factors(noise.rate, times)
    return Whitener(*angle, *rate)


def _factors(channel: Channel, times: Array) -> tuple[Array, Array]:
    return (
        np.linalg.inv(np.linalg.cholesky(channel.in_time(times))),
        np.linalg.inv(np.linalg.cholesky(channel.joints)),
    )


def _whitened(values: Array, in_time: Array, joints: Array) -> Array:
    by_time = in_time @ values.reshape(values.shape[0], -1)
    return np.asarray(np.matmul(joints, by_time.reshape(*values.shape[:2], -1)))

"""Recordings of an arm that rests between motions, and the joint angles in which it does."""

import numpy as np

from continuum.dynamics.tensions import Tensions
from continuum.recordings.recording import Recording

RATE = 120.0
RAMP, REST = 0.8, 2.0  # [s]


def stops(postures: np.ndarray, rest: float = REST, ramp: float = RAMP) -> tuple[np.ndarray, np.ndarray]:
    """Times (rows,) [s] and angles (rows, n) [rad] of an arm that moves evenly from posture to posture and rests there.

    Rests begin at (rest + ramp) k.
    """
    knots = (rest + ramp) * np.repeat(np.arange(len(postures)), 2) + np.tile([0.0, rest], len(postures))
    times = np.arange(int(knots[-1] * RATE) + 1) / RATE
    angles = [np.interp(times, knots, np.repeat(column, 2)) for column in postures.T]
    return times, np.stack(angles, axis=1)


def measured(
    times: np.ndarray, theta: np.ndarray, rng: np.random.Generator, white: float, pull: np.ndarray | None = None
) -> Recording:
    """With white noise [rad], and tensions (rows, 2) [N]."""
    noisy = theta + white * rng.standard_normal(theta.shape)
    return Recording("run", times, noisy, None, None if pull is None else Tensions(times, pull))

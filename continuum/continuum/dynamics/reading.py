"""What sensors read of a motion."""

from __future__ import annotations

from dataclasses import dataclass

from continuum.arrays import Array


@dataclass(frozen=True)
class Reading:
    """Joint angles and rates at the sampled times.

    Attributes:
        times: (n_times,) [s].
        theta: joint angles, (n_times, n_joints) [rad].
        theta_rate: joint rates, (n_times, n_joints) [rad/s].
        begun: when the recording began of which this may be a part [s].
    """

    times: Array
    theta: Array
    theta_rate: Array
    begun: float

"""What perfect sensors would read of a motion, before an effect on the sensors spoils it."""

from __future__ import annotations

from dataclasses import dataclass

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.trajectory import Trajectory


@dataclass(frozen=True)
class Reading:
    """Joint angles and rates at the sampled times.

    Attributes:
        times: (n_times,) [s].
        theta: joint angles, (n_times, n_joints) [rad].
        theta_rate: joint rates, (n_times, n_joints) [rad/s].
    """

    times: Array
    theta: Array
    theta_rate: Array


def readings(model: Model, trajectory: Trajectory) -> Reading:
    """What the sensors of a model read of a simulated motion: its effects on measuring, one after the other."""
    seen = Reading(trajectory.times, trajectory.theta, trajectory.theta_rate)
    for active in model.effects:
        seen = active.effect.measure(seen, active.values)
    return seen

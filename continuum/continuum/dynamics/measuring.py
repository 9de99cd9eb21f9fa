"""What a model's sensors read of a simulated motion."""

from __future__ import annotations

from continuum.dynamics.model import Model
from continuum.dynamics.reading import Reading
from continuum.dynamics.trajectory import Trajectory


def readings(model: Model, trajectory: Trajectory) -> Reading:
    """Angles and rates after all effects on measuring, one after the other; without any, those of the motion."""
    seen = Reading(trajectory.times, trajectory.theta, trajectory.theta_rate)
    for active in model.effects:
        seen = active.effect.measure(seen, active.values)
    return seen

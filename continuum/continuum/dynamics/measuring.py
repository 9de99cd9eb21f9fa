"""What a model's sensors read of a simulated motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.dynamics.model import Model
from continuum.dynamics.trajectory import Reading, Trajectory


def readings(model: Model, trajectory: Trajectory, begun: float | None = None) -> Reading:
    """Angles and rates after all effects on measuring, one after the other; without any, those of the motion.

    Args:
        model: whose effects may change what is read.
        trajectory: the motion, or a part of one.
        begun: when the motion began [s]; with the trajectory without.
    """
    start = float(trajectory.times[0]) if begun is None else begun
    seen = Reading(trajectory.times, trajectory.theta, trajectory.theta_rate, start)
    for active in model.effects:
        seen = active.effect.measure(seen, active.values)
    return seen


def lateness(model: Model) -> float:
    """By how much all sensors are late [s]."""
    return float(sum(np.sum(active.effect.late(active.values)) for active in model.effects))


def as_read(model: Model, motion: Trajectory) -> Trajectory:
    """The motion with angles and rates as the model's sensors read them; the same where they read it plainly.

    Before its first sample the arm is taken to have been as it was there.
    """
    from scipy.interpolate import CubicHermiteSpline

    late, states, n = lateness(model), motion.states.copy(), motion.n_joints
    if late > 0 and motion.times.size > 1:
        course = CubicHermiteSpline(motion.times, motion.theta, motion.theta_rate)
        then = np.maximum(motion.times - late, motion.times[0])
        states[:, :n], states[:, n : 2 * n] = course(then), course(then, 1)
    seen = readings(model, replace(motion, states=states))
    states[:, :n], states[:, n : 2 * n] = seen.theta, seen.theta_rate
    return replace(motion, states=states)

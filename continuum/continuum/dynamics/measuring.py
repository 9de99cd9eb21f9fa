"""Readings of a model's sensors during a simulated motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.dynamics.model import Model
from continuum.dynamics.trajectory import Reading, Trajectory


def readings(model: Model, trajectory: Trajectory, begun: float | None = None) -> Reading:
    """Return angles and rates after all measurement effects in order; without such effects, those of the motion.

    Args:
        model: the model whose effects may change the readings.
        trajectory: the motion, or a part of it.
        begun: start time of the motion [s]; by default the first time of the trajectory.
    """
    start = float(trajectory.times[0]) if begun is None else begun
    seen = Reading(trajectory.times, trajectory.theta, trajectory.theta_rate, start)
    for active in model.effects:
        seen = active.effect.measure(seen, active.values)
    return seen


def lateness(model: Model) -> float:
    """Return the delay of all sensors [s]."""
    return float(sum(np.sum(active.effect.late(active.values)) for active in model.effects))


def as_read(model: Model, motion: Trajectory) -> Trajectory:
    """Return the motion with angles and rates as the model's sensors read them; ideal sensors do not change it.

    Before the first sample, the arm is assumed to have been in the state of the first sample.
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

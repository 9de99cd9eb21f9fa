"""What sensors read of a simulated motion, where the model has effects on sensors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.dynamics.measuring import lateness, readings
from continuum.dynamics.model import Model
from continuum.dynamics.trajectory import Trajectory


def as_read(model: Model, motion: Trajectory) -> Trajectory:
    """The motion with angles and rates as the sensors of the model read them; the same where they read it plainly."""
    from scipy.interpolate import CubicHermiteSpline

    late, states = lateness(model), motion.states.copy()
    n = motion.n_joints
    if late > 0 and motion.times.size > 1:  # before the first sample the arm is as it was there
        course = CubicHermiteSpline(motion.times, motion.theta, motion.theta_rate)
        then = np.maximum(motion.times - late, motion.times[0])
        states[:, :n], states[:, n : 2 * n] = course(then), course(then, 1)
    seen = readings(model, replace(motion, states=states))
    states[:, :n], states[:, n : 2 * n] = seen.theta, seen.theta_rate
    return replace(motion, states=states)

"""Ideal sensors on every link: rotation and specific force of the planar chain in the axes of its links.

Axes of the base: z along the straight arm, x towards the first cable, so that positive bends rotate about y, z to x.
Link i points along u_i = (sin T_i, 0, cos T_i) with T_i the sum of the joint angles up to i, and changes along
n_i = du_i / dT_i. The joints are 2b apart, the first one b below the base plate, and the sensors are b beyond theirs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.parameters import Parameters


@dataclass(frozen=True)
class LinkMotion:
    """Motion of the links at one instant.

    Attributes:
        angles: angles of the links relative to the base, (n,) [rad].
        velocities: velocities of the sensors in axes of the base, (n, 3) [m/s].
    """

    angles: Array
    velocities: Array


def link_motion(theta: Array, theta_rate: Array, half_spacing: float) -> LinkMotion:
    """Return the motion for joint angles and rates, (n,) [rad], [rad/s], and half the joint distance b [m]."""
    angles, speeds = np.cumsum(theta), np.cumsum(theta_rate)
    moved = speeds[:, None] * across(angles)
    passed = np.cumsum(2.0 * half_spacing * moved, axis=0) - 2.0 * half_spacing * moved  # by preceding links
    return LinkMotion(angles, passed + half_spacing * moved)


def along(angles: Array) -> Array:
    """Return the directions of links at these angles, (n, 3)."""
    return np.stack([np.sin(angles), np.zeros_like(angles), np.cos(angles)], axis=1)


def across(angles: Array) -> Array:
    """Return the directions in which the links' far ends move for growing angles, (n, 3)."""
    return np.stack([np.cos(angles), np.zeros_like(angles), -np.sin(angles)], axis=1)


def gravity(model: Model) -> Array:
    """Return gravity in axes of the base, (3,) [m/s^2]; effects may tilt it."""
    p = effective_parameters(model)
    return np.asarray(p.gravity[0] * along(-p.hang_angle)[0])


def half_spacing(model: Model) -> float:
    """Return b of the first joint [m]."""
    return float(np.asarray(effective_parameters(model).half_spacing)[0])


def effective_parameters(model: Model) -> Parameters:
    """Return the parameters of Eq. 12 as modified by the model's effects."""
    p = model.parameters
    for active in model.effects:
        p = active.effect.change_parameters(p, active.values)
    return p


def effective(before: LinkMotion, after: LinkMotion, duration: float, fall: Array) -> Array:
    """Return the mean specific force (n, 3) [m/s^2] of each sensor in its link's axes over a short ``duration`` [s].

    ``fall`` is gravity in axes of the base, (3,) [m/s^2].
    """
    force = (after.velocities - before.velocities) / duration - fall
    middle = (before.angles + after.angles) / 2.0
    x = np.sum(force * across(middle), axis=1)
    z = np.sum(force * along(middle), axis=1)
    return np.stack([x, force[:, 1], z], axis=1)

"""The course of a planar arm in space: base plate, joints and tip."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.parameters import Parameters


def backbone(theta: Array, p: Parameters) -> Array:
    """Return base plate, joints and tip of an arm in its plane, (n_joints + 2, 2) [m], the second axis upwards."""
    link_angle = np.cumsum(theta) + p.hang_angle
    lengths = np.concatenate([p.mount, p.joint_spacing[:-1], p.tip])
    directions = np.concatenate([p.hang_angle, link_angle])
    steps = lengths[:, None] * np.stack([np.sin(directions), -np.cos(directions)], axis=1)
    return np.asarray(np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)]))

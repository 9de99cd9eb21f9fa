"""Where a joint turned back, and how far it has gone since."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array

_NOISE = 0.01  # rad, back by which a joint has turned for sure


def way_since_turn(theta: Array) -> Array:
    """How far every joint has gone since it last turned back, or since the beginning, (n_times, n_joints) [rad].

    Args:
        theta: joint angles, (n_times, n_joints) [rad].
    """
    way = np.empty_like(theta)
    for joint, angles in enumerate(theta.T):
        turned = farthest = angles[0]
        for i, angle in enumerate(angles):
            if abs(angle - turned) >= abs(farthest - turned) and (angle - turned) * (farthest - turned) >= 0:
                farthest = angle
            elif abs(angle - farthest) > _NOISE:
                turned, farthest = farthest, angle
            way[i, joint] = abs(angle - turned)
    return way

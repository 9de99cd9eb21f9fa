"""Whether the arm bends towards the cable that pulls more, as cable 1 does towards positive angles.

  r = correlation of u_1 - u_2 with the mean of all joint angles, over the rows of one run

Simulated runs, the fast and the lagging ones too, have r between 0.16 and 0.97. Of one below -1/2 the cables' columns
are swapped, or the angles' signs; a fit would seek long, and end with parameters at their limits.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array

_OPPOSED = -0.5
_PULLED = 2.0  # N, between the largest and the least difference of tensions; load cells err by tenths


def odd_sides(theta: Array, pull: Array) -> list[str]:
    """A sentence where the arm bends away from the cable that pulls more; none where all is well.

    Args:
        theta: joint angles, (rows, n_joints) [rad].
        pull: tensions, (rows, 2) [N].
    """
    difference, bend = pull[:, 0] - pull[:, 1], theta.mean(axis=1)
    if np.ptp(difference) < _PULLED or np.ptp(bend) == 0:
        return []
    r = float(np.corrcoef(difference, bend)[0, 1])
    if r > _OPPOSED:
        return []
    away = f"the arm bends away from the cable that pulls more (correlation {r:.2f})"
    return [f"{away}: cable 1 bends it towards positive angles; are u1 and u2 swapped, or the signs of the angles?"]

"""What the joints carry."""

import numpy as np

from blind.moreau.chain import Chain
from blind.moreau.compiled import compiled
from blind.plant.parameters import JOINTS


@compiled
def carried(
    chain: Chain,
    load: float,
    turned: np.ndarray,
    rate: np.ndarray,
    acceleration: np.ndarray,
    pull: np.ndarray,
    tension: np.ndarray,
) -> np.ndarray:
    """Force between the two links of each joint (5,) [N].

    It holds what lies beyond against gravity and accelerates it, less what the cables pull across the joint, along
    their chords: straight up from a frame turned by half the joint's angle.

    Args:
        chain: the bodies.
        load: point mass at the last one's centre [kg].
        turned: absolute angles (n,) [rad].
        rate: absolute rates (n,) [rad/s].
        acceleration: absolute ones (n,) [rad/s^2].
        pull: acceleration of gravity (2,) [m/s^2].
        tension: of both cables together across each joint (5,) [N].
    """
    n = turned.size
    needed = np.empty((n, 2))
    hinge = -pull
    for k in range(n):
        cos, sin = np.cos(turned[k]), np.sin(turned[k])
        turning = np.array([cos, sin]) * acceleration[k] - np.array([sin, -cos]) * rate[k] ** 2
        needed[k] = (chain.mass[k] + (load if k == n - 1 else 0.0)) * (hinge + chain.centre[k] * turning)
        hinge = hinge + chain.length[k] * turning
    for k in range(n - 2, -1, -1):
        needed[k] += needed[k + 1]
    force = np.empty(JOINTS)
    for i in range(JOINTS):
        before = chain.hinge[i] - 1
        chord = 0.5 * (turned[chain.link[i]] + (turned[before] if before >= 0 else 0.0))
        across = needed[chain.link[i], 0] + tension[i] * np.sin(chord)
        along = needed[chain.link[i], 1] - tension[i] * np.cos(chord)
        force[i] = np.hypot(across, along)
    return force

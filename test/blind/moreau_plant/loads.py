"""What the joints carry."""

import numpy as np

from blind.moreau_plant.chain import Chain
from blind.moreau_plant.compiled import compiled
from blind.mujoco_plant.parameters import JOINTS


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
    across, along = -pull[0], -pull[1]  # what the hinge is held at and accelerates by
    for k in range(n):
        mass = chain.mass[k] + (load if k == n - 1 else 0.0)
        cos, sin = np.cos(turned[k]), np.sin(turned[k])
        sideways, upwards = cos * acceleration[k] - sin * rate[k] ** 2, sin * acceleration[k] + cos * rate[k] ** 2
        needed[k, 0] = mass * (across + chain.centre[k] * sideways)
        needed[k, 1] = mass * (along + chain.centre[k] * upwards)
        across += chain.length[k] * sideways
        along += chain.length[k] * upwards
    force = np.empty(JOINTS)
    across = along = 0.0
    i = JOINTS - 1
    for k in range(n - 1, -1, -1):
        across += needed[k, 0]
        along += needed[k, 1]
        if i >= 0 and k == chain.link[i]:
            before = chain.hinge[i] - 1
            chord = 0.5 * (turned[k] + (turned[before] if before >= 0 else 0.0))
            force[i] = np.hypot(across + tension[i] * np.sin(chord), along - tension[i] * np.cos(chord))
            i -= 1
    return force

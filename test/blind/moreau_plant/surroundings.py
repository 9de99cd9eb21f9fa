"""Forces on the links from their surroundings: the medium's drag, the strap to the first sensor."""

import numpy as np

from blind.moreau_plant.chain import Chain, to_hinges
from blind.moreau_plant.compiled import compiled
from blind.moreau_plant.mechanism import Mechanism

STRAP_LENGTH = 0.15  # from clamp to sensor while the arm is straight [m]
STRAP_REST = 0.95  # where it neither pulls nor pushes, over that
SENSOR = -0.045  # across the first link from its axis [m]
STRAP_DAMPING = 0.01  # over its stiffness [s]
STRAP_FRICTION = 0.015  # [m]
PARTS = 6  # of a link, each of which has one speed


@compiled
def add_drag(m: Mechanism, chain: Chain, turned: np.ndarray, rate: np.ndarray, torque: np.ndarray) -> None:
    """Add -c v |v| per length of every link, v the speed across it, to the torques of absolute angles (n,) [N m]."""
    sideways = upwards = 0.0  # speed of the hinge
    body = 0
    for link in chain.link:
        while body < link:  # a base plate, a ball
            sideways += chain.length[body] * rate[body] * np.cos(turned[body])
            upwards += chain.length[body] * rate[body] * np.sin(turned[body])
            body += 1
        cos, sin = np.cos(turned[link]), np.sin(turned[link])
        piece = chain.length[link] / PARTS
        total = 0.0
        for part in range(PARTS):
            along = (part + 0.5) * piece
            across = sideways * cos + upwards * sin + rate[link] * along
            force = -m.drag * piece * across * abs(across)
            total += force
            torque[link] += force * along
        for before in range(link):
            torque[before] += total * chain.length[before] * np.cos(turned[link] - turned[before])
        sideways += chain.length[link] * rate[link] * cos
        upwards += chain.length[link] * rate[link] * sin
        body = link + 1


@compiled
def strap(m: Mechanism, chain: Chain, turned: np.ndarray) -> tuple[float, np.ndarray]:
    """Stretch of the strap [m], and its length by the hinges' angles (n,) [m/rad]."""
    link, b = chain.link[0], m.half_spacing
    slope = np.zeros(turned.size)
    cos, sin = np.cos(turned[link]), np.sin(turned[link])
    x, z = SENSOR * cos + b * sin, SENSOR * sin - b * cos
    if chain.hinge[0] == 0:
        z -= b
    else:
        x += b * np.sin(turned[0])
        z -= b * np.cos(turned[0])
    x, z = x - (SENSOR - STRAP_LENGTH), z + 2 * b  # from the clamp
    length = np.hypot(x, z)
    x, z = x / length, z / length
    slope[link] = x * (-SENSOR * sin + b * cos) + z * (SENSOR * cos + b * sin)
    if chain.hinge[0] > 0:
        slope[0] += b * (x * np.cos(turned[0]) + z * np.sin(turned[0]))
    to_hinges(slope)
    return length - STRAP_REST * STRAP_LENGTH, slope

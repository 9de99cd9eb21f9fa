"""The two cables: their chords across the joints, and how they rub at the discs by the belt formula.

The chord of cable 1 or 2 across a joint has the length 2 (b cos(theta/2) -+ a sin(theta/2)). At disc k a cable turns by
phi_k = |theta_k + theta_k+1| / 2 (at the base plate |theta_1| / 2), and its tensions before and behind differ by at
most the mean of both times 2 tanh(mu_c phi_k / 2), which is where it slides and T' = T exp(-+ mu_c phi_k).
"""

import numpy as np

from blind.moreau_plant.compiled import compiled
from blind.mujoco_plant.parameters import JOINTS


@compiled
def lengths(angle: np.ndarray, a: float, b: float) -> np.ndarray:
    """From the base plate to the tip (2,) [m], for joint angles (5,) [rad]."""
    up = out = 0.0
    for theta in angle:
        up += 2 * b * np.cos(theta / 2)
        out += 2 * a * np.sin(theta / 2)
    return np.array([up - out, up + out])


@compiled
def sensitivities(angle: np.ndarray, a: float, b: float) -> np.ndarray:
    """Length of each chord by its joint's angle (2, 5) [m/rad]."""
    slope = np.empty((2, JOINTS))
    for i in range(JOINTS):
        slope[0, i] = -b * np.sin(angle[i] / 2) - a * np.cos(angle[i] / 2)
        slope[1, i] = -b * np.sin(angle[i] / 2) + a * np.cos(angle[i] / 2)
    return slope


@compiled
def belt_limits(angle: np.ndarray, pull: np.ndarray, friction: np.ndarray, mu: float) -> np.ndarray:
    """Largest friction at each disc (2, 5) [N].

    Args:
        angle: of the joints (5,) [rad].
        pull: tensions at the base (2,) [N].
        friction: at the discs one step ago (2, 5) [N], positive where it lowers the tension beyond.
        mu: coefficient of friction.
    """
    limit = np.empty((2, JOINTS))
    for c in range(2):
        tension = pull[c]
        for k in range(JOINTS):
            turn = 0.5 * abs(angle[k] + (angle[k - 1] if k > 0 else 0.0))
            mean = tension - 0.5 * friction[c, k]
            limit[c, k] = max(0.0, 2 * np.tanh(0.5 * mu * turn) * mean)
            tension -= friction[c, k]
    return limit

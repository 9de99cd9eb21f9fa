"""Distance from a target to all that an arm can reach, by brute force: many postures, the best of them polished."""

from functools import lru_cache

import numpy as np
from scipy.optimize import minimize

from continuum.arm import Arm
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.configuration import allen_from_jones
from continuum_laws.samples import random_postures


def distance_of_one_section(arm: Arm, position: np.ndarray) -> float:
    """Distance [m] from ``position`` (3,) [m] to the tips of one section, by grids of bend and azimuth, each finer."""
    limit = arm.sections[0].bend_limit
    low, high = np.array([-np.pi, 0.0]), np.array([np.pi, limit])
    best = np.inf
    for _ in range(9):
        axes = [np.linspace(a, b, 121) for a, b in zip(low, high, strict=True)]
        phi, theta = (axis.ravel() for axis in np.meshgrid(*axes))
        tips = arm_pose(allen_from_jones(phi, theta)[:, None, :], arm)[:, :3, 3]
        distances = np.linalg.norm(tips - position, axis=-1)
        k = int(np.argmin(distances))
        best = min(best, float(distances[k]))
        reach = 4.0 * (high - low) / 120
        low, high = np.array([phi[k], theta[k]]) - reach, np.array([phi[k], theta[k]]) + reach
        low[1], high[1] = np.clip([low[1], high[1]], 0.0, limit)
    return best


@lru_cache
def drawn(arm: Arm, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Random postures (n, n_sections, 2) [rad], more bends at their limits than chance would give, and tips [m]."""
    random, postures = np.random.default_rng(99), random_postures(arm, n, seed=98)
    limits = np.array([section.bend_limit for section in arm.sections])
    stretched = random.random((n, arm.n_sections, 1)) < 0.3
    bends = np.linalg.norm(postures, axis=-1, keepdims=True)
    postures = np.where(stretched, postures * limits[:, None] / bends, postures)
    return postures, arm_pose(postures, arm)[:, :3, 3]


def distance_of_sections(arm: Arm, position: np.ndarray, n: int = 20000, n_polished: int = 6) -> float:
    """Distance [m] from ``position`` (3,) [m] to the tips within the bend limits; SciPy's SLSQP polishes the best."""
    limits = np.array([section.bend_limit for section in arm.sections])
    postures, tips = drawn(arm, n)
    order = np.argsort(np.linalg.norm(tips - position, axis=-1))

    def half_square(x: np.ndarray) -> float:
        return 0.5 * np.sum((arm_pose(x.reshape(-1, 2), arm)[:3, 3] - position) ** 2) / arm.length**2

    def gradient(x: np.ndarray) -> np.ndarray:
        w = x.reshape(-1, 2)
        return arm_jacobian(w, arm)[:3].T @ (arm_pose(w, arm)[:3, 3] - position) / arm.length**2

    def room(x: np.ndarray) -> np.ndarray:
        return limits**2 - np.sum(x.reshape(-1, 2) ** 2, axis=-1)

    def room_slope(x: np.ndarray) -> np.ndarray:
        slope = np.zeros((arm.n_sections, x.size))
        for i in range(arm.n_sections):
            slope[i, 2 * i : 2 * i + 2] = -2.0 * x[2 * i : 2 * i + 2]
        return slope

    within = {"type": "ineq", "fun": room, "jac": room_slope}
    best = np.inf
    for k in order[:n_polished]:
        options = {"ftol": 1e-15, "maxiter": 300}
        found = minimize(
            half_square, postures[k].ravel(), jac=gradient, method="SLSQP", constraints=within, options=options
        )
        w = found.x.reshape(-1, 2)
        w = w * np.minimum(1.0, limits / np.maximum(np.linalg.norm(w, axis=-1), 1e-300))[:, None]
        best = min(best, float(np.linalg.norm(arm_pose(w, arm)[:3, 3] - position)))
    return best

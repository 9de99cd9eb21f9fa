"""Derivatives by central differences of eighth order: exact to about 1e-13 at steps where rounding does no harm."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

_WEIGHTS = (4 / 5, -1 / 5, 4 / 105, -1 / 280)


def differences(function: Callable[[np.ndarray], np.ndarray], at: ArrayLike, step: ArrayLike = 0.02) -> np.ndarray:
    """d function / d at, (..., *shape of a value, k), for points ``at`` (..., k), one step or one a point."""
    at = np.asarray(at, dtype=float)
    step = np.broadcast_to(np.asarray(step, dtype=float), at.shape[:-1])
    columns = []
    for unit in np.eye(at.shape[-1]):
        total = 0.0
        for m, weight in enumerate(_WEIGHTS, start=1):
            shift = m * step[..., None] * unit
            total = total + weight * (function(at + shift) - function(at - shift))
        columns.append(total / step.reshape(step.shape + (1,) * (np.ndim(total) - step.ndim)))
    return np.stack(columns, axis=-1)


def geometric_jacobian(pose: Callable[[np.ndarray], np.ndarray], at: ArrayLike) -> np.ndarray:
    """Linear velocity of a pose's origin and its angular velocity, (..., 6, k), for coordinates ``at`` (..., k)."""
    sensitivities = differences(pose, at)
    spins = np.einsum("...ijk,...lj->...ilk", sensitivities[..., :3, :3, :], pose(np.asarray(at))[..., :3, :3])
    angular = np.stack([spins[..., 2, 1, :], spins[..., 0, 2, :], spins[..., 1, 0, :]], axis=-2)
    return np.concatenate([sensitivities[..., :3, 3, :], angular], axis=-2)


def assert_same_derivatives(found: np.ndarray, expected: np.ndarray, relative: float = 1e-9) -> None:
    """Matrices (..., m, k) agree, each measured by its own largest entry."""
    assert found.shape == expected.shape
    scale = np.max(np.abs(expected), axis=(-2, -1), keepdims=True)
    worst = np.max(np.abs(found - expected) / scale)
    assert worst <= relative, f"relative error {worst:.2e}"

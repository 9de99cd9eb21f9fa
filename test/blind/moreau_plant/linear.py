"""Small vectors and symmetric systems."""

import numpy as np

from blind.moreau_plant.compiled import compiled


@compiled
def dot(a: np.ndarray, b: np.ndarray) -> float:
    """Of two vectors (n,)."""
    total = 0.0
    for k in range(a.size):
        total += a[k] * b[k]
    return total


@compiled
def factorise(matrix: np.ndarray) -> None:
    """The lower triangle of a positive definite matrix (n, n) becomes L, with L L' the matrix."""
    n = len(matrix)
    for i in range(n):
        for k in range(i + 1):
            value = matrix[i, k]
            for c in range(k):
                value -= matrix[i, c] * matrix[k, c]
            matrix[i, k] = np.sqrt(value) if i == k else value / matrix[k, k]


@compiled
def forward(factor: np.ndarray, vector: np.ndarray) -> None:
    """A vector x (n,) becomes L^-1 x."""
    for i in range(vector.size):
        for c in range(i):
            vector[i] -= factor[i, c] * vector[c]
        vector[i] /= factor[i, i]


@compiled
def back(factor: np.ndarray, vector: np.ndarray) -> None:
    """A vector x (n,) becomes L'^-1 x."""
    for i in range(vector.size - 1, -1, -1):
        for c in range(i + 1, vector.size):
            vector[i] -= factor[c, i] * vector[c]
        vector[i] /= factor[i, i]

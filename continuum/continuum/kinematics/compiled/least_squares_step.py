"""Damped least-squares step for a wide or tall Jacobian, by Cholesky factorisation of the smaller normal equations."""

from __future__ import annotations

import math

from continuum.arrays import Array
from continuum.kinematics.compiled.equations import compiled


@compiled
def least_squares_step(jacobian: Array, error: Array, damping: float, normal: Array, step: Array) -> bool:
    """Fill ``step`` (k,) with (J^T J + damping I)^-1 J^T e; False where the matrix is not positive definite.

    With fewer rows than columns it solves the equivalent J^T (J J^T + damping I)^-1 e.

    Args:
        jacobian: (at least m, k); its first m rows count.
        error: (m,).
        damping: >= 0.
        normal: work space, at least (min(m, k), min(m, k)).
        step: (k,), the result.
    """
    m, k = len(error), len(step)
    rows = jacobian[:m]
    if m <= k:
        solution = error.copy()
        _fill_normal(rows, damping, normal)
        if not solve_positive_definite(normal, solution):
            return False
        _fill_transposed_product(rows, solution, step)
        return True
    _fill_normal(rows.T, damping, normal)
    _fill_transposed_product(rows, error, step)
    return solve_positive_definite(normal, step)


@compiled
def _fill_normal(rows: Array, damping: float, normal: Array) -> None:
    """Fill the lower triangle of ``normal`` with rows rows^T + damping I."""
    for i in range(rows.shape[0]):
        for j in range(i + 1):
            total = 0.0
            for c in range(rows.shape[1]):
                total += rows[i, c] * rows[j, c]
            normal[i, j] = total
        normal[i, i] += damping


@compiled
def _fill_transposed_product(rows: Array, x: Array, y: Array) -> None:
    """Fill ``y`` with rows^T x."""
    for c in range(rows.shape[1]):
        total = 0.0
        for r in range(rows.shape[0]):
            total += rows[r, c] * x[r]
        y[c] = total


@compiled
def solve_positive_definite(matrix: Array, x: Array) -> bool:
    """Solve ``matrix`` y = ``x`` in place, overwriting the lower triangle; return False if it is not definite."""
    n = len(x)
    for j in range(n):
        pivot = matrix[j, j]
        for c in range(j):
            pivot -= matrix[j, c] * matrix[j, c]
        if not pivot > 0.0:
            return False
        root = math.sqrt(pivot)
        matrix[j, j] = root
        for i in range(j + 1, n):
            total = matrix[i, j]
            for c in range(j):
                total -= matrix[i, c] * matrix[j, c]
            matrix[i, j] = total / root
    for i in range(n):
        for c in range(i):
            x[i] -= matrix[i, c] * x[c]
        x[i] /= matrix[i, i]
    for i in range(n - 1, -1, -1):
        for c in range(i + 1, n):
            x[i] -= matrix[c, i] * x[c]
        x[i] /= matrix[i, i]
    return True

"""Damped least-squares step for a wide or a tall Jacobian, by Cholesky's factors of the smaller normal equations."""

from __future__ import annotations

import math

from continuum.arrays import Array
from continuum.kinematics.compiled.equations import compiled


@compiled
def least_squares_step(jacobian: Array, error: Array, damping: float, normal: Array, step: Array) -> bool:
    """Fill ``step`` (k,) with (J^T J + damping I)^-1 J^T e; False where the matrix is not positive definite.

    With fewer rows than columns the same step is J^T (J J^T + damping I)^-1 e, the shortest that does it.

    Args:
        jacobian: (at least m, k); its first m rows count.
        error: (m,).
        damping: >= 0.
        normal: work space, at least (min(m, k), min(m, k)).
        step: (k,), the result.
    """
    m, k = len(error), len(step)
    if m <= k:
        solution = error.copy()
        for i in range(m):
            for j in range(i + 1):
                total = 0.0
                for c in range(k):
                    total += jacobian[i, c] * jacobian[j, c]
                normal[i, j] = total
            normal[i, i] += damping
        if not solve_positive_definite(normal, solution):
            return False
        for c in range(k):
            total = 0.0
            for i in range(m):
                total += jacobian[i, c] * solution[i]
            step[c] = total
        return True
    for i in range(k):
        for j in range(i + 1):
            total = 0.0
            for r in range(m):
                total += jacobian[r, i] * jacobian[r, j]
            normal[i, j] = total
        normal[i, i] += damping
        total = 0.0
        for r in range(m):
            total += jacobian[r, i] * error[r]
        step[i] = total
    return solve_positive_definite(normal, step)


@compiled
def solve_positive_definite(matrix: Array, x: Array) -> bool:
    """Solve ``matrix`` y = ``x`` in place; reads the lower triangle, which it overwrites. False if not definite."""
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

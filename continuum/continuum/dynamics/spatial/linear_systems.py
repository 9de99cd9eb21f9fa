"""Symmetric positive definite systems in compiled loops: upper triangles of the leading (n, n), four pivots at once."""

from __future__ import annotations

from continuum.arrays import Array
from continuum.dynamics.spatial.compiling import inner


@inner
def factor(A: Array, n: int) -> bool:
    """Replace the upper triangle by D L^T of A = L D L^T; return whether all pivots are positive."""
    k = 0
    while k + 3 < n:
        for a in range(k, k + 4):
            if not A[a, a] > 0.0:
                return False
            scale = 1.0 / A[a, a]
            for i in range(a + 1, k + 4):
                f = A[a, i] * scale
                for j in range(i, n):
                    A[i, j] -= f * A[a, j]
        r0, r1, r2, r3 = 1.0 / A[k, k], 1.0 / A[k + 1, k + 1], 1.0 / A[k + 2, k + 2], 1.0 / A[k + 3, k + 3]
        for i in range(k + 4, n):
            f0, f1, f2, f3 = A[k, i] * r0, A[k + 1, i] * r1, A[k + 2, i] * r2, A[k + 3, i] * r3
            for j in range(i, n):
                A[i, j] -= f0 * A[k, j] + f1 * A[k + 1, j] + f2 * A[k + 2, j] + f3 * A[k + 3, j]
        k += 4
    while k < n:
        if not A[k, k] > 0.0:
            return False
        scale = 1.0 / A[k, k]
        for i in range(k + 1, n):
            f = A[k, i] * scale
            for j in range(i, n):
                A[i, j] -= f * A[k, j]
        k += 1
    return True


@inner
def solve(A: Array, b: Array, n: int) -> None:
    """Solve L D L^T x = b in place with the factors of `factor`."""
    for k in range(n):
        b[k] /= A[k, k]
        f = b[k]
        for j in range(k + 1, n):
            b[j] -= f * A[k, j]
    for k in range(n - 1, -1, -1):
        total = 0.0
        for j in range(k + 1, n):
            total += A[k, j] * b[j]
        b[k] -= total / A[k, k]

"""Dense linear systems in compiled loops: LU with row pivoting, in place."""

from __future__ import annotations

import numpy as np

from continuum.dynamics.integration.compiled_loops import compiled


@compiled
def factorise(A, pivots):  # type: ignore[no-untyped-def]
    """Factorise ``A`` (n, n) to LU in place and fill ``pivots``; return False if it is singular or not finite."""
    n = A.shape[0]
    for k in range(n):
        best = k
        for r in range(k + 1, n):
            if abs(A[r, k]) > abs(A[best, k]):
                best = r
        pivots[k] = best
        if not abs(A[best, k]) > 0.0 or not np.isfinite(A[best, k]):
            return False
        if best != k:
            for c in range(n):
                A[k, c], A[best, c] = A[best, c], A[k, c]
        for r in range(k + 1, n):
            factor = A[r, k] / A[k, k]
            A[r, k] = factor
            for c in range(k + 1, n):
                A[r, c] -= factor * A[k, c]
    return True


@compiled
def solve_factorised(A, pivots, b):  # type: ignore[no-untyped-def]
    """Solve for every column of ``b`` (n, columns) in place, with the factors and pivots of `factorise`."""
    n, columns = b.shape
    for k in range(n):
        best = pivots[k]
        if best != k:
            for c in range(columns):
                b[k, c], b[best, c] = b[best, c], b[k, c]
    for k in range(n):
        for r in range(k + 1, n):
            for c in range(columns):
                b[r, c] -= A[r, k] * b[k, c]
    for k in range(n - 1, -1, -1):
        for c in range(columns):
            b[k, c] /= A[k, k]
        for r in range(k):
            for c in range(columns):
                b[r, c] -= A[r, k] * b[k, c]

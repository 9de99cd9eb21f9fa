"""One implicit stage: find the rates v at which the equations hold, the state being x = base + h g (rates).

The state is x = (theta, theta', z), its rates are (theta', v) with v = (theta'', z'). Eliminating theta leaves one
matrix of the size of v: dr/dv + h g dr/d(theta', z) + (h g)^2 dr/dtheta.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.integration.call_at import call_at
from continuum.dynamics.integration.compiled_loops import compiled


@compiled
def place_stage(packed, base, v, hg, n):  # type: ignore[no-untyped-def]
    """Write the state and its rates into ``packed``, which the equations read."""
    nv = v.size
    for r in range(nv):
        packed[n + r] = base[n + r] + hg * v[r]
        packed[n + nv + r] = v[r]
    for r in range(n):
        packed[r] = base[r] + hg * packed[n + r]


@compiled
def stage_matrix(out, J, hg, n):  # type: ignore[no-untyped-def]
    """The matrix above, from r, dr/dv, dr/dx packed by columns in ``out``."""
    nv = J.shape[0]
    at_x = nv + nv * nv
    for c in range(nv):
        for r in range(nv):
            J[r, c] = out[nv + nv * c + r] + hg * out[at_x + nv * (n + c) + r]
            if c < n:
                J[r, c] += hg * hg * out[at_x + nv * c + r]


@compiled
def factorise(J, pivots):  # type: ignore[no-untyped-def]
    """LU with row pivoting, in place; False where the matrix is singular or not finite."""
    n = J.shape[0]
    for k in range(n):
        best = k
        for r in range(k + 1, n):
            if abs(J[r, k]) > abs(J[best, k]):
                best = r
        pivots[k] = best
        if not abs(J[best, k]) > 0.0 or not np.isfinite(J[best, k]):
            return False
        if best != k:
            for c in range(n):
                J[k, c], J[best, c] = J[best, c], J[k, c]
        for r in range(k + 1, n):
            factor = J[r, k] / J[k, k]
            J[r, k] = factor
            for c in range(k + 1, n):
                J[r, c] -= factor * J[k, c]
    return True


@compiled
def solve_factorised(J, pivots, b):  # type: ignore[no-untyped-def]
    """Solve for every column of ``b`` (n, columns), in place."""
    n, columns = b.shape
    for k in range(n):
        best = pivots[k]
        if best != k:
            for c in range(columns):
                b[k, c], b[best, c] = b[best, c], b[k, c]
    for k in range(n):
        for r in range(k + 1, n):
            for c in range(columns):
                b[r, c] -= J[r, k] * b[k, c]
    for k in range(n - 1, -1, -1):
        for c in range(columns):
            b[k, c] /= J[k, k]
        for r in range(k):
            for c in range(columns):
                b[r, c] -= J[r, k] * b[k, c]


@compiled
def solve_stage(newton, packed, out, J, pivots, base, v, hg, n, rtol, atol):  # type: ignore[no-untyped-def]
    """Newton's method from the guess ``v``, which becomes the answer; returns whether it converged.

    It ends when the change of the state, h g dv, is a hundredth of the tolerance.
    """
    nv = v.size
    step = np.empty((nv, 1))
    for _ in range(10):
        place_stage(packed, base, v, hg, n)
        call_at(newton, packed, out)
        stage_matrix(out, J, hg, n)
        if not factorise(J, pivots):
            return False
        step[:, 0] = out[:nv]
        solve_factorised(J, pivots, step)
        size = 0.0
        for r in range(nv):
            v[r] -= step[r, 0]
            size = max(size, hg * abs(step[r, 0]) / (atol + rtol * abs(packed[n + r])))
        if not np.isfinite(size):
            return False
        if size < 0.01:
            place_stage(packed, base, v, hg, n)
            return True
    return False

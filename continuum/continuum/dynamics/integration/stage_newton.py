"""One implicit stage: find the rates v at which the equations hold, the state being x = base + h g (rates).

The state is x = (theta, theta', z), its rates are (theta', v) with v = (theta'', z'). Eliminating theta leaves one
matrix of the size of v: dr/dv + h g dr/d(theta', z) + (h g)^2 dr/dtheta. It is exact, and kept, from stage to stage
of a step too, as long as the iteration converges fast with it: the residual alone costs a fraction of it.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.integration.call_at import call_at
from continuum.dynamics.integration.compiled_loops import compiled
from continuum.dynamics.integration.linear_solve import factorise, solve_factorised

_MOST_ITERATIONS = 12
_FAST = 0.4  # a change this much smaller than the one before it
_SOLVED = 0.01  # a change of the state this small, in units of the tolerance


@compiled
def place_stage(packed, base, v, hg, n):  # type: ignore[no-untyped-def]
    """Write the state and its rates into ``packed``, which the equations read."""
    n_v = v.size
    for r in range(n_v):
        packed[n + r] = base[n + r] + hg * v[r]
        packed[n + n_v + r] = v[r]
    for r in range(n):
        packed[r] = base[r] + hg * packed[n + r]


@compiled
def factorise_stage_matrix(out, matrix, pivots):  # type: ignore[no-untyped-def]
    """The matrix above, which stands in ``out`` by columns after r; whether it has an inverse."""
    n_v = pivots.size
    for c in range(n_v):
        for r in range(n_v):
            matrix[r, c] = out[n_v + n_v * c + r]
    return factorise(matrix, pivots)


@compiled
def solve_stage(problem, method, work, base, v, hg, matrix_serves):  # type: ignore[no-untyped-def]
    """Newton's method from the guess ``v``, which becomes the answer; whether it converged, ``work.packed`` then too.

    Args:
        problem, method, work: see there.
        base: the state but for these rates, (n_x,).
        v: rates, (n_v,).
        hg: h g [s].
        matrix_serves: whether ``work`` holds the matrix of another stage with the same ``hg``.
    """
    n, change_before = problem.n_joints, np.inf
    packed, out, matrix, pivots, step = work.packed, work.out, work.matrix, work.pivots, work.change
    packed[-1] = hg
    for _ in range(_MOST_ITERATIONS):
        place_stage(packed, base, v, hg, n)
        if matrix_serves:
            call_at(problem.residual, packed, out)
        else:
            call_at(problem.stage, packed, out)
            if not factorise_stage_matrix(out, matrix, pivots):
                return False
        step[:, 0] = out[: v.size]
        solve_factorised(matrix, pivots, step)
        change = 0.0
        for r in range(v.size):
            v[r] -= step[r, 0]
            change = max(change, hg * abs(step[r, 0]) / (method.absolute + method.relative * abs(packed[n + r])))
        if not np.isfinite(change):
            return False
        if change < _SOLVED:
            place_stage(packed, base, v, hg, n)
            return True
        matrix_serves = change < _FAST * change_before
        change_before = change
    return False

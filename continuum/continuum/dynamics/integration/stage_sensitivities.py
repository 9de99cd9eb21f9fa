"""Exact slopes of a solved stage by initial state and parameters: one more linear solve with the stage's own matrix."""

from __future__ import annotations

from continuum.dynamics.integration.call_at import call_at
from continuum.dynamics.integration.compiled_loops import compiled
from continuum.dynamics.integration.linear_solve import solve_factorised
from continuum.dynamics.integration.stage_newton import factorise_stage_matrix


@compiled
def stage_sensitivities(problem, work, base_sensitivity, hg, rate_sensitivities):  # type: ignore[no-untyped-def]
    """Slopes of the rates of the stage that ``work.packed`` holds; whether there are any.

    Args:
        problem, work: see there.
        base_slope: of the stage's state but for its own rates, (n_x, n_free).
        hg: h g [s].
        rate_slopes: the answer, of (theta', v), (n_x, n_free).
    """
    n, n_v = problem.n_joints, work.pivots.size
    n_x, n_free = base_sensitivity.shape
    out, matrix, pivots, row = work.out, work.matrix, work.pivots, work.row
    work.packed[-1] = hg
    call_at(problem.sensitivities, work.packed, out)
    if not factorise_stage_matrix(out, matrix, pivots):
        return False
    v_sensitivities = rate_sensitivities[n:]
    v_sensitivities[:] = 0.0
    at_x = n_v + n_v * n_v
    at_p = at_x + n_v * n_x
    for k in range(n_x):
        row[:] = base_sensitivity[k]
        if k < n:  # theta moves with theta' of this very stage, which moves with its base
            row += hg * base_sensitivity[n + k]
        for r in range(n_v):
            sensitivity = out[at_x + n_v * k + r]
            for c in range(n_free):
                v_sensitivities[r, c] -= sensitivity * row[c]
    for i in range(problem.direction_rows.size):
        at, c = at_p + n_v * problem.direction_rows[i], problem.direction_columns[i]
        for r in range(n_v):
            v_sensitivities[r, c] -= out[at + r] * problem.direction_values[i]
    solve_factorised(matrix, pivots, v_sensitivities)
    for r in range(n):
        for c in range(n_free):
            rate_sensitivities[r, c] = base_sensitivity[n + r, c] + hg * v_sensitivities[r, c]
    return True

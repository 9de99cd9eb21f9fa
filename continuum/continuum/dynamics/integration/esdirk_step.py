"""One step of an ESDIRK method: its stages, and their exact derivatives by initial state and parameters.

The derivatives of a stage cost one more linear solve with the matrix of that stage.
"""

from __future__ import annotations

from continuum.dynamics.integration.compiled_loops import call_at, compiled
from continuum.dynamics.integration.linear_solve import solve_factorised
from continuum.dynamics.integration.problem import inputs_at
from continuum.dynamics.integration.stage_newton import factorise_stage_matrix, solve_stage


@compiled
def first_stage(problem, method, work, t, x, sensitivity):  # type: ignore[no-untyped-def]
    """Compute the rates at ``t`` and their derivatives, the start of the first step; return whether they exist."""
    n = problem.n_joints
    v = work.rates[0, n:]
    inputs_at(t, t, problem.input_times, problem.inputs, work.u)
    if not solve_stage(problem, method, work, x, v, 0.0, False):
        return False
    work.rates[0, :n] = x[n : 2 * n]
    return sensitivity.shape[1] == 0 or stage_sensitivities(problem, work, sensitivity, 0.0, work.rate_sensitivities[0])


@compiled
def solve_stages(problem, method, work, t, x, step):  # type: ignore[no-untyped-def]
    """Compute states and rates of every stage of the step from ``x`` at ``t``; return whether all were solved."""
    n = problem.n_joints
    for i in range(1, method.c.size):
        _stage_base(work.base, x, step, method.a[i, :i], work.rates)
        v = work.rates[i, n:]
        hg = step * method.a[i, i]
        before = x if i == 1 else work.states[i - 1]  # a stuck joint stays stuck for any initial guess of its rates
        v[:] = (before[n:] - work.base[n:]) / hg
        inputs_at(t, t + method.c[i] * step, problem.input_times, problem.inputs, work.u)
        if not solve_stage(problem, method, work, work.base, v, hg, i > 1):
            return False
        work.states[i] = work.packed[: x.size]
        work.rates[i, :n] = work.states[i, n : 2 * n]
    return True


@compiled
def sensitivities_of_stages(problem, method, work, t, step, sensitivity):  # type: ignore[no-untyped-def]
    """Replace sensitivities at the start of a solved step by those at its end; return whether they exist."""
    n, n_x = problem.n_joints, sensitivity.shape[0]
    for i in range(1, method.c.size):
        _stage_base(work.base_sensitivity, sensitivity, step, method.a[i, :i], work.rate_sensitivities)
        work.packed[:n_x] = work.states[i]
        work.packed[n_x : n_x + work.pivots.size] = work.rates[i, n:]
        inputs_at(t, t + method.c[i] * step, problem.input_times, problem.inputs, work.u)
        if not stage_sensitivities(
            problem, work, work.base_sensitivity, step * method.a[i, i], work.rate_sensitivities[i]
        ):
            return False
    sensitivity[:] = work.base_sensitivity  # the last stage is the result
    _add(sensitivity, step * method.a[-1, -1], work.rate_sensitivities[-1])
    return True


@compiled
def _stage_base(base, x, step, weights, rates):  # type: ignore[no-untyped-def]
    """Fill ``base`` with x + step sum_j weights_j rates_j over the preceding stages, for states or derivatives."""
    base[:] = x
    for j in range(weights.size):
        if weights[j] != 0.0:
            _add(base, step * weights[j], rates[j])


@compiled
def _add(total, factor, more):  # type: ignore[no-untyped-def]
    """Add factor * more to ``total`` in place, without a temporary array."""
    flat, added = total.ravel(), more.ravel()
    for k in range(flat.size):
        flat[k] += factor * added[k]


@compiled
def stage_sensitivities(problem, work, base_sensitivity, hg, rate_sensitivities):  # type: ignore[no-untyped-def]
    """Compute the sensitivities of the rates of the stage in ``work.packed``; return whether they exist.

    Args:
        problem, work: see `Problem` and `Work`.
        base_sensitivity: sensitivity of the stage's state without the contribution of its rates, (n_x, n_free).
        hg: h g [s].
        rate_sensitivities: the result, sensitivities of (theta', v), (n_x, n_free).
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
        if k < n:  # theta depends on theta' of the same stage, which depends on its base
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

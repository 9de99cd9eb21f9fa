"""One step of an ESDIRK method: its stages, and their exact slopes."""

from __future__ import annotations

from continuum.dynamics.integration.compiled_loops import compiled
from continuum.dynamics.integration.inputs_at import inputs_at
from continuum.dynamics.integration.stage_newton import solve_stage
from continuum.dynamics.integration.stage_sensitivities import stage_sensitivities


@compiled
def first_stage(problem, method, work, t, x, sensitivity):  # type: ignore[no-untyped-def]
    """Rates at ``t`` and their slopes, with which the first step begins; whether there are any."""
    n = problem.n_joints
    v = work.rates[0, n:]
    inputs_at(t, t, problem.input_times, problem.inputs, work.u)
    if not solve_stage(problem, method, work, x, v, 0.0, False):
        return False
    work.rates[0, :n] = x[n : 2 * n]
    return sensitivity.shape[1] == 0 or stage_sensitivities(problem, work, sensitivity, 0.0, work.rate_sensitivities[0])


@compiled
def solve_stages(problem, method, work, t, x, step):  # type: ignore[no-untyped-def]
    """States and rates of every stage of the step from ``x`` at ``t``; whether all were solved."""
    n = problem.n_joints
    for i in range(1, method.c.size):
        _stage_base(work.base, x, step, method.a[i, :i], work.rates)
        v = work.rates[i, n:]
        hg = step * method.a[i, i]
        before = x if i == 1 else work.states[i - 1]  # a stuck joint stays, whatever its rates begin with
        v[:] = (before[n:] - work.base[n:]) / hg
        inputs_at(t, t + method.c[i] * step, problem.input_times, problem.inputs, work.u)
        if not solve_stage(problem, method, work, work.base, v, hg, i > 1):
            return False
        work.states[i] = work.packed[: x.size]
        work.rates[i, :n] = work.states[i, n : 2 * n]
    return True


@compiled
def sensitivities_of_stages(problem, method, work, t, step, sensitivity):  # type: ignore[no-untyped-def]
    """Slopes at the end of a step whose stages are solved, in place of those at its start; whether there are any."""
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
    """x + step sum_j weights_j rates_j over the stages before one; of states or of their slopes."""
    base[:] = x
    for j in range(weights.size):
        if weights[j] != 0.0:
            _add(base, step * weights[j], rates[j])


@compiled
def _add(total, factor, more):  # type: ignore[no-untyped-def]
    """total + factor more, in place and without a temporary array."""
    flat, added = total.ravel(), more.ravel()
    for k in range(flat.size):
        flat[k] += factor * added[k]

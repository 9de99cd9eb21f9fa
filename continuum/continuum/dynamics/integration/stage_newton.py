"""One implicit stage: find the rates v at which the equations hold, the state being x = base + h g (rates).

The state is x = (theta, theta', z), its rates are (theta', v) with v = (theta'', z'). Eliminating theta leaves one
matrix of the size of v: dr/dv + h g dr/d(theta', z) + (h g)^2 dr/dtheta. It is exact, and is reused between iterations
and between the stages of a step as long as the iteration converges fast: a residual costs a fraction of a matrix.

Dry friction saturates, so that full steps away from a stuck joint would overshoot forever. A step is therefore
shortened until the next step with the same matrix is shorter (natural monotonicity test: Deuflhard, Newton Methods for
Nonlinear Problems, 2004, section 3.3).
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.integration.compiled_loops import call_at, compiled
from continuum.dynamics.integration.linear_solve import factorise, solve_factorised

_MOST_ITERATIONS = 8  # matrices
_FAST = 0.4  # fast convergence: each change is smaller than this fraction of the previous one
_SOLVED = 0.01  # change of the state that ends the iteration, in units of the tolerance
_LEAST_SHARE = 0.05  # smallest fraction of a step
_MOST_SHORTENED, _LEAST_SHORTENED = 0.1, 0.5  # limits of the factor that shortens a step
_DONE, _SLOW, _STUCK = range(3)  # outcomes of the steps with one matrix


@compiled
def place_stage(packed, base, v, hg, n):  # type: ignore[no-untyped-def]
    """Write the state and its rates into ``packed``, the argument of the equations."""
    n_v = v.size
    for r in range(n_v):
        packed[n + r] = base[n + r] + hg * v[r]
        packed[n + n_v + r] = v[r]
    for r in range(n):
        packed[r] = base[r] + hg * packed[n + r]


@compiled
def factorise_stage_matrix(out, matrix, pivots):  # type: ignore[no-untyped-def]
    """Factorise the stage matrix, stored by columns in ``out`` after r; return whether it is regular."""
    n_v = pivots.size
    for c in range(n_v):
        for r in range(n_v):
            matrix[r, c] = out[n_v + n_v * c + r]
    return factorise(matrix, pivots)


@compiled
def solve_stage(problem, method, work, base, v, hg, matrix_serves):  # type: ignore[no-untyped-def]
    """Solve by Newton's method from the guess ``v``, in place; return whether it converged.

    After convergence ``work.packed`` holds the solution too.

    Args:
        problem, method, work: see `Problem`, `Method` and `Work`.
        base: the state without the contribution of these rates, (n_x,).
        v: rates, (n_v,).
        hg: h g [s].
        matrix_serves: whether ``work`` holds the matrix of another stage with the same ``hg``.
    """
    packed, out, matrix, pivots, step = work.packed, work.out, work.matrix, work.pivots, work.change
    packed[-1] = hg
    for _ in range(_MOST_ITERATIONS):
        place_stage(packed, base, v, hg, problem.n_joints)
        if matrix_serves:
            call_at(problem.residual, packed, out)
        else:
            call_at(problem.stage, packed, out)
            if not factorise_stage_matrix(out, matrix, pivots):
                return False
        step[:, 0] = out[: v.size]
        solve_factorised(matrix, pivots, step)
        end = _follow(problem, method, work, base, v, hg)
        if end == _DONE:
            return True
        if end == _STUCK and not matrix_serves:
            return False
        matrix_serves = False
    return False


@compiled
def _follow(problem, method, work, base, v, hg):  # type: ignore[no-untyped-def]
    """Take the step ``work.change`` and further steps with the same matrix while they converge fast."""
    n, packed, out, step, further = problem.n_joints, work.packed, work.out, work.change, work.further
    share, change = 1.0, _size(step, packed, hg, n, method)
    if not np.isfinite(change):
        return _STUCK
    while share > _LEAST_SHARE:
        for r in range(v.size):
            v[r] -= share * step[r, 0]
        place_stage(packed, base, v, hg, n)
        if share == 1.0 and change < _SOLVED:
            return _DONE
        call_at(problem.residual, packed, out)
        further[:, 0] = out[: v.size]
        solve_factorised(work.matrix, work.pivots, further)
        left = _size(further, packed, hg, n, method)
        if left < (1 - 0.5 * share) * change:
            if share < 1.0 or not left < _FAST * change:
                return _SLOW
            step[:], change = further, left
            continue
        if share == 1.0 and _stopped(packed, step, base, v, hg, n):
            return _SLOW
        for r in range(v.size):
            v[r] += share * step[r, 0]
        share *= _shortened(step, further)
    return _STUCK


@compiled
def _stopped(packed, step, base, v, hg, n):  # type: ignore[no-untyped-def]
    """Stop the joints whose motion a step would reverse; return whether there are any."""
    any_stopped = False
    for r in range(n):
        now = packed[n + r]
        if now * (now + hg * step[r, 0]) < 0.0:
            v[r] = -base[n + r] / hg
            any_stopped = True
    return any_stopped


@compiled
def _size(step, packed, hg, n, method):  # type: ignore[no-untyped-def]
    """Return the largest change of the state by a step of the rates, in units of the tolerance."""
    largest = 0.0
    for r in range(step.shape[0]):
        if not np.isfinite(step[r, 0]):
            return np.inf
        change = hg * abs(step[r, 0]) / (method.absolute + method.relative * abs(packed[n + r]))
        largest = max(largest, change)
    return largest


@compiled
def _shortened(step, further):  # type: ignore[no-untyped-def]
    """Return the factor to the root of a straight line along the step, within its limits."""
    along = length = 0.0
    for r in range(step.shape[0]):
        along += step[r, 0] * further[r, 0]
        length += step[r, 0] ** 2
    if not along < 0.0:  # or it is not finite
        return _LEAST_SHORTENED
    return min(max(length / (length - along), _MOST_SHORTENED), _LEAST_SHORTENED)

"""The fast integrator: an adaptive ESDIRK method on the implicit equations r(x, v, u, p) = 0, and its exact slopes.

Every stage is solved by Newton's method with the exact Jacobian, so that a stage's own derivative by initial state
and parameters is one more linear solve with the same matrix: the sensitivities are those of the computed trajectory,
its steps held, and cost no further iterations. Steps end on every output time and where the tensions bend; nothing is
interpolated.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from continuum.dynamics.integration.call_at import call_at
from continuum.dynamics.integration.compiled_loops import compiled, entry_point
from continuum.dynamics.integration.stage_newton import (
    factorise,
    place_stage,
    solve_factorised,
    solve_stage,
    stage_matrix,
)

_MOST_STEPS = 200_000  # between two outputs


@compiled
def _set_tensions(packed, at, t, input_times, inputs):  # type: ignore[no-untyped-def]
    """Tensions at ``t`` by linear interpolation, held before the first and after the last row."""
    last = input_times.size - 1
    k = np.searchsorted(input_times, t, side="right") - 1
    for j in range(inputs.shape[1]):
        if k < 0 or last == 0:
            packed[at + j] = inputs[0, j]
        elif k >= last:
            packed[at + j] = inputs[last, j]
        else:
            part = (t - input_times[k]) / (input_times[k + 1] - input_times[k])
            packed[at + j] = (1 - part) * inputs[k, j] + part * inputs[k + 1, j]


@compiled
def _stage_slopes(slopes, packed, out, J, pivots, base_slope, hg, n, directions, rates_slope):  # type: ignore[no-untyped-def]
    """Slope of a solved stage's rates, (2 n + extra, free), from that of its base; False where there is none."""
    nv = J.shape[0]
    nx = base_slope.shape[0]
    call_at(slopes, packed, out)
    stage_matrix(out, J, hg, n)
    if not factorise(J, pivots):
        return False
    moved = base_slope.copy()
    for r in range(n):
        moved[r] += hg * base_slope[n + r]
    by_x = out[nv + nv * nv : nv + nv * nv + nv * nx].reshape(nx, nv).T
    by_p = out[nv + nv * nv + nv * nx :].reshape(directions.shape[0], nv).T
    right = -(np.ascontiguousarray(by_x) @ moved + np.ascontiguousarray(by_p) @ directions)
    solve_factorised(J, pivots, right)
    rates_slope[:n] = base_slope[n : 2 * n] + hg * right[:n]
    rates_slope[n:] = right
    return True


@compiled
def _error_size(K, error, h, x, new, rtol, atol):  # type: ignore[no-untyped-def]
    """Root mean square of the estimated error in units of the tolerance."""
    total = 0.0
    for r in range(x.size):
        estimate = 0.0
        for i in range(K.shape[0]):
            estimate += error[i] * K[i, r]
        total += (h * estimate / (atol + rtol * max(abs(x[r]), abs(new[r])))) ** 2
    return np.sqrt(total / x.size)


def _build(digest: str) -> Callable[..., Any]:
    def integrate(  # type: ignore[no-untyped-def]
        newton, slopes, n, x0, p, times, input_times, inputs, a, c, error, order,
        rtol, atol, max_step, directions, slope0,
    ):  # fmt: skip
        """States (times, nx), their slopes (times, nx, free), steps taken and refused, status; see `fast`."""
        _ = digest
        stages, hg1 = a.shape[0], a[1, 1]
        nx, free = x0.size, slope0.shape[1]
        nv, nu = nx - n, inputs.shape[1]
        at_u = nx + nv
        states, state_slopes = np.full((times.size, nx), np.nan), np.full((times.size, nx, free), np.nan)
        packed, out = np.zeros(at_u + nu + p.size), np.zeros(nv + nv * nv + nv * nx + nv * p.size)
        packed[at_u + nu :] = p
        J, pivots = np.empty((nv, nv)), np.zeros(nv, dtype=np.int64)
        K, dK = np.zeros((stages, nx)), np.zeros((stages, nx, free))
        base, dbase = np.empty(nx), np.empty((nx, free))
        t, x, dx = times[0], x0.copy(), slope0.copy()
        states[0], state_slopes[0] = x, dx
        taken, refused, h, status = 0, 0, min(1e-4, max_step), 0
        v = np.zeros(nv)
        _set_tensions(packed, at_u, t, input_times, inputs)
        if not solve_stage(newton, packed, out, J, pivots, x, v, 0.0, n, rtol, atol):
            return states, state_slopes, taken, refused, 2
        solve_stage(newton, packed, out, J, pivots, x, v, 0.0, n, rtol, atol)
        K[0, :n], K[0, n:] = x[n : 2 * n], v
        if free > 0:
            _stage_slopes(slopes, packed, out, J, pivots, dx, 0.0, n, directions, dK[0])
        knot = 0
        for k in range(1, times.size):
            at_most = taken + refused + _MOST_STEPS
            while t < times[k]:
                while knot < input_times.size and input_times[knot] <= t:
                    knot += 1
                stop = times[k]
                if knot < input_times.size and input_times[knot] < stop:
                    stop = input_times[knot]
                left = stop - t
                step = min(h, max_step)
                ends = step >= left * (1 - 1e-10)
                if ends:
                    step = left
                elif step > 0.5 * left:
                    step = 0.5 * left
                if step < 1e-12 * max(1.0, abs(t)) or taken + refused > at_most:
                    return states, state_slopes, taken, refused, 1
                good = True
                hg = step * hg1
                for i in range(1, stages):
                    base[:] = x
                    for j in range(i):
                        if a[i, j] != 0.0:
                            base += step * a[i, j] * K[j]
                    v[:] = K[i - 1, n:]
                    _set_tensions(packed, at_u, t + c[i] * step, input_times, inputs)
                    if not solve_stage(newton, packed, out, J, pivots, base, v, hg, n, rtol, atol):
                        good = False
                        break
                    K[i, :n], K[i, n:] = packed[n : 2 * n], v
                if not good:
                    h, refused = 0.25 * step, refused + 1
                    continue
                size = _error_size(K, error, step, x, packed[:nx], rtol, atol)
                if not size <= 1.0:
                    h, refused = step * max(0.2, 0.9 * size ** (-1.0 / order)) if size > 0 else 0.25 * step, refused + 1
                    continue
                if free > 0:
                    for i in range(1, stages):
                        base[:] = x
                        dbase[:] = dx
                        for j in range(i):
                            if a[i, j] != 0.0:
                                base += step * a[i, j] * K[j]
                                dbase += step * a[i, j] * dK[j]
                        _set_tensions(packed, at_u, t + c[i] * step, input_times, inputs)
                        place_stage(packed, base, K[i, n:], hg, n)
                        _stage_slopes(slopes, packed, out, J, pivots, dbase, hg, n, directions, dK[i])
                    dx[:] = dbase + hg * dK[stages - 1]
                    dK[0] = dK[stages - 1]
                x[:] = packed[:nx]
                K[0] = K[stages - 1]
                grown = step * min(5.0, 0.9 * max(size, 1e-10) ** (-1.0 / order))
                h = grown if not ends else max(grown, min(h, grown * 5.0))
                t = stop if ends else t + step
                taken += 1
            states[k], state_slopes[k] = x, dx
        if not np.all(np.isfinite(states)):
            status = 2
        return states, state_slopes, taken, refused, status

    return integrate


integrate = entry_point(_build)

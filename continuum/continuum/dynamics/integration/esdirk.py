"""The fast integrator: an adaptive ESDIRK method for the implicit equations r(x, v, u, p) = 0, with exact derivatives.

Newton's method solves every stage with the exact Jacobian, so that the derivative of a stage by initial state and
parameters is one more linear solve with the same matrix. The sensitivities are those of the computed trajectory for
fixed steps, and cost no further iterations. Steps end at every output time and at every kink or jump of the inputs;
nothing is interpolated.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.integration.compiled_loops import compiled, entry_point
from continuum.dynamics.integration.esdirk_step import first_stage, sensitivities_of_stages, solve_stages
from continuum.dynamics.integration.problem import jumps_at, work_for
from continuum.dynamics.integration.step_size import FIRST_STEP, error_size, longer, shorter, step_towards
from continuum.dynamics.trajectory import SimulationStatus

STATUSES = (SimulationStatus.COMPLETE, SimulationStatus.STEP_TOO_SMALL, SimulationStatus.NOT_FINITE)
"""Statuses by the index that `integrate` returns."""
_COMPLETE, _STEP_TOO_SMALL, _NOT_FINITE = range(len(STATUSES))
_ONE_INSTANT = 1e-12  # times that differ by less [s], or relative to the time, differ by rounding only


@compiled
def _next_bend(input_times, t):  # type: ignore[no-untyped-def]
    """Return the time of the inputs' next kink after ``t``; infinite if there is none."""
    k = np.searchsorted(input_times, t, side="right")
    return input_times[k] if k < input_times.size else np.inf


@entry_point
def integrate(problem, method, x0, times, sensitivity0):  # type: ignore[no-untyped-def]
    """Return states (n_times, n_x), derivatives (n_times, n_x, n_free), steps, refused steps, index in `STATUSES`."""
    x, sensitivity, free = x0.copy(), sensitivity0.copy(), sensitivity0.shape[1]
    work = work_for(problem, x.size, free, method.c.size)
    states, sensitivities = np.full((times.size, x.size), np.nan), np.full((times.size, x.size, free), np.nan)
    states[0], sensitivities[0] = x, sensitivity
    t, taken, refused = times[0], 0, 0
    if not first_stage(problem, method, work, t, x, sensitivity):
        return states, sensitivities, taken, refused, _NOT_FINITE
    wanted, size_before, just_refused = FIRST_STEP, 1.0, False
    for k in range(1, times.size):
        most = taken + refused + method.most_steps
        while t < times[k]:
            stop = min(times[k], _next_bend(problem.input_times, t))
            shortest = _ONE_INSTANT * max(1.0, abs(t))
            if stop - t < shortest:  # an output and a kink, or two kinks; the inputs may jump
                t = stop
                if not first_stage(problem, method, work, t, x, sensitivity):
                    return states, sensitivities, taken, refused, _NOT_FINITE
                continue
            step, ends = step_towards(stop, t, min(wanted, method.max_step))
            if step < shortest or taken + refused > most:
                return states, sensitivities, taken, refused, _STEP_TOO_SMALL
            size, new = np.inf, work.states[-1]
            if solve_stages(problem, method, work, t, x, step):
                size = error_size(step, method.error, work.rates, x, new, method.relative, method.absolute)
            if not size <= 1.0:
                wanted, refused, just_refused = shorter(step, size, method.order), refused + 1, True
                continue
            if free > 0 and not sensitivities_of_stages(problem, method, work, t, step, sensitivity):
                return states, sensitivities, taken, refused, _NOT_FINITE
            grown = longer(step, size, size_before, method.order, just_refused)
            wanted = max(wanted, grown) if ends else grown  # a truncated step is no reason for short steps
            size_before, just_refused = size, False
            x[:], work.rates[0], work.rate_sensitivities[0] = new, work.rates[-1], work.rate_sensitivities[-1]
            t, taken = stop if ends else t + step, taken + 1
            if ends and jumps_at(t, problem.input_times) and not first_stage(problem, method, work, t, x, sensitivity):
                return states, sensitivities, taken, refused, _NOT_FINITE
        states[k], sensitivities[k] = x, sensitivity
    status = _COMPLETE if np.all(np.isfinite(states)) else _NOT_FINITE
    return states, sensitivities, taken, refused, status

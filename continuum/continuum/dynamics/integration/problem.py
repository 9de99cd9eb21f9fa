"""Arguments of the compiled loops, the inputs at an instant, and the arrays that the loops reuse at every step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.dynamics.integration.compiled_loops import compiled

IntArray = NDArray[np.int64]


class Problem(NamedTuple):
    """The problem to integrate.

    Attributes:
        residual, stage, sensitivities: addresses of a model's machine code; the last is 0 if no sensitivities are
            needed.
        n_joints: number of joints.
        p: parameter values, (n_p,).
        input_times, inputs: inputs that drive the arm, (rows,) [s] and (rows, n_inputs), as `InputSignal.rows`.
        direction_rows, direction_columns, direction_values: parameter directions by which to differentiate, as the
            nonzero entries of a matrix (n_p, n_free), (n_entries,) each.
    """

    residual: int
    stage: int
    sensitivities: int
    n_joints: int
    p: Array
    input_times: Array
    inputs: Array
    direction_rows: IntArray
    direction_columns: IntArray
    direction_values: Array


class Method(NamedTuple):
    """The integration method: a Runge-Kutta method as in `Tableau`, and tolerances as in `Tolerances`."""

    a: Array
    c: Array
    error: Array
    order: int
    relative: float
    absolute: float
    max_step: float
    most_steps: int


class Work(NamedTuple):
    """Arrays for one integration: n_x states, n_v rates to be solved for, n_free quantities to differentiate by.

    Attributes:
        packed: arguments of the equations: state, rates, inputs, parameters, h g.
        u: view of the inputs in ``packed``.
        out: results of the equations.
        matrix, pivots: factorised matrix of Newton's method, (n_v, n_v) and (n_v,).
        change, further: change of the rates in one iteration and in the next, (n_v, 1).
        row: row of a matrix of derivatives, (n_free,).
        base, base_sensitivity: state of a stage without the contribution of its rates, and its sensitivity, (n_x,) and
            (n_x, n_free).
        states, rates, rate_sensitivities: values of every stage, (stages, n_x), (stages, n_x) and
            (stages, n_x, n_free).
    """

    packed: Array
    u: Array
    out: Array
    matrix: Array
    pivots: Array
    change: Array
    further: Array
    row: Array
    base: Array
    base_sensitivity: Array
    states: Array
    rates: Array
    rate_sensitivities: Array


@compiled
def work_for(problem, n_x, n_free, stages):  # type: ignore[no-untyped-def]
    """Allocate the arrays for one integration."""
    n_v, n_u, n_p = n_x - problem.n_joints, problem.inputs.shape[1], problem.p.size
    packed = np.zeros(n_x + n_v + n_u + n_p + 1)
    packed[n_x + n_v + n_u : -1] = problem.p
    return Work(
        packed=packed,
        u=packed[n_x + n_v : n_x + n_v + n_u],
        out=np.zeros(n_v * (1 + n_v + n_x + n_p)),
        matrix=np.empty((n_v, n_v)),
        pivots=np.zeros(n_v, dtype=np.int64),
        change=np.empty((n_v, 1)),
        further=np.empty((n_v, 1)),
        row=np.empty(n_free),
        base=np.empty(n_x),
        base_sensitivity=np.empty((n_x, n_free)),
        states=np.empty((stages, n_x)),
        rates=np.zeros((stages, n_x)),
        rate_sensitivities=np.zeros((stages, n_x, n_free)),
    )


@compiled
def inputs_at(begin, t, times, values, u):  # type: ignore[no-untyped-def]
    """Write into ``u`` the inputs at ``t``: linear between the rows, held before the first and after the last.

    ``begin`` is the start of the step that contains ``t``: a step that ends at a jump, two rows with equal times, uses
    the inputs before the jump.
    """
    last = times.size - 1
    k = min(max(np.searchsorted(times, begin, side="right") - 1, 0), last)
    part = 0.0
    if k < last and t > times[k]:
        part = (t - times[k]) / (times[k + 1] - times[k])
    for j in range(values.shape[1]):
        u[j] = (1 - part) * values[k, j] + part * values[min(k + 1, last), j]


@compiled
def jumps_at(t, times):  # type: ignore[no-untyped-def]
    """Return whether two rows have the time ``t``."""
    k = np.searchsorted(times, t, side="right") - 1
    return k > 0 and times[k] == t and times[k - 1] == t

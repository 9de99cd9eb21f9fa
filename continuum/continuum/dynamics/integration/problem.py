"""What the compiled loops are given, the inputs at an instant, and the arrays that they use again at every step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.dynamics.integration.compiled_loops import compiled

IntArray = NDArray[np.int64]


class Problem(NamedTuple):
    """What is integrated.

    Attributes:
        residual, stage, sensitivities: addresses of a model's machine code; the last is 0 where none are asked for.
        n_joints: number of joints.
        p: parameter values, (n_p,).
        input_times, inputs: what drives the arm, (rows,) [s] and (rows, n_inputs), as `InputSignal.rows`.
        direction_rows, direction_columns, direction_values: directions in the parameters by which to differentiate,
            entries of a matrix (n_p, n_free) that is mostly zero, (n_entries,) each.
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
    """How it is integrated: a Runge-Kutta method as in `Tableau`, and its tolerances as in `Tolerances`."""

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
        packed: state, rates, inputs, parameters, h g: what the equations read.
        u: the inputs in it.
        out: what the equations answer.
        matrix, pivots: of Newton's method, factorised, (n_v, n_v) and (n_v,).
        change, further: of the rates in one iteration and in the next, (n_v, 1).
        row: of a matrix of derivatives, (n_free,).
        base, base_slope: a stage's state but for its own rates, and its slope, (n_x,) and (n_x, n_free).
        states, rates, rate_slopes: of every stage, (stages, n_x), (stages, n_x) and (stages, n_x, n_free).
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
    """Arrays for one integration."""
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

    ``begin`` is the start of the step that ``t`` is in: where two rows of one time make a jump, a step that ends there
    still has the inputs before it.
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
    """Whether two rows have the time ``t``."""
    k = np.searchsorted(times, t, side="right") - 1
    return k > 0 and times[k] == t and times[k - 1] == t

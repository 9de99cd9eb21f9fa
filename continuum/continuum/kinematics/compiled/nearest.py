"""Nearest pose to a target out of reach: Newton's method on half the squared error, within the bend limits.

Where the error does not vanish, the second derivatives that Gauss-Newton neglects matter. The gradient J^T e is exact,
and its central differences give the Hessian. A section at its limit keeps its bend and moves along the limit by its
azimuth until the descent points inward.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.equations import compiled, merged
from continuum.kinematics.compiled.least_squares_step import solve_positive_definite
from continuum.kinematics.compiled.limits import AT_LIMIT, pull_within
from continuum.kinematics.compiled.task import TargetArrays, evaluate, squared

_DIFFERENCE = 1e-5  # step of the differences [rad]
_LARGEST_STEP = 0.5  # of any coordinate in one iteration [rad]
_MAX_ITERATIONS = 100
_NEARER = 1e-6  # smallest relative reduction of a squared error that counts
_ALIKE, _NEIGHBOURS = 1e-2, 0.2  # relative difference of squared errors and distance [rad] of ends that count as one
_EQUAL = 1e-6  # relative difference of squared errors below which ends count as one at any distance
_ROUNDING = 1e-13  # relative change of a squared error that rounding may hide
_STATIONARY = 1e-10  # gradient of half the squared error, in weights per rad, that ends the search


@merged
def descend_to_nearest(arm: ArmArrays, target: TargetArrays, w: Array) -> tuple[int, bool]:
    """Move ``w`` (2 n_sections,) [rad] in place towards a local minimum; return iterations and whether it is one."""
    size = len(w)
    error, jacobian = np.empty(target.n_rows), np.empty((6, size))
    on_limit = np.zeros(len(arm.b), np.bool_)
    trial = np.empty(size)
    pull_within(arm, w)
    cost, gradient = _cost_and_gradient(arm, target, w, error, jacobian)
    damping = 0.0
    for iteration in range(_MAX_ITERATIONS):
        _choose_held(arm, w, gradient, on_limit)
        basis = _directions(w, on_limit)
        reduced = basis @ gradient
        if np.max(np.abs(reduced)) < _STATIONARY * target.weight**2:
            return iteration, True
        hessian = _hessian(arm, target, w, on_limit, basis, error, jacobian)
        improved = False
        while not improved and damping < 1e8:
            step = -reduced
            normal = hessian.copy()
            for k in range(len(step)):
                normal[k, k] += damping
            if solve_positive_definite(normal, step):
                trial[:] = w
                _move(trial, step, on_limit)
                pull_within(arm, trial)
                trial_cost, trial_gradient = _cost_and_gradient(arm, target, trial, error, jacobian)
                improved = trial_cost < cost
            if not improved:
                damping = max(4.0 * damping, 1e-3 * target.weight**2)
        if not improved:
            # Rounding hides the remaining gain: a minimum if the slope predicts no larger one.
            stiffest = np.max(np.abs(np.diag(hessian))) if len(hessian) > 0 else 0.0
            return iteration, np.max(np.abs(reduced)) ** 2 <= _ROUNDING * cost * stiffest
        w[:] = trial
        cost, gradient = trial_cost, trial_gradient
        damping = 0.1 * damping if damping > 1e-8 * target.weight**2 else 0.0
    return _MAX_ITERATIONS, False


@compiled
def _cost_and_gradient(
    arm: ArmArrays, target: TargetArrays, w: Array, error: Array, jacobian: Array
) -> tuple[float, Array]:
    evaluate(arm, target, w, error, jacobian)
    gradient = np.zeros(len(w))
    for k in range(len(w)):
        for r in range(target.n_rows):
            gradient[k] -= jacobian[r, k] * error[r]
    return 0.5 * squared(error), gradient


@merged
def _choose_held(arm: ArmArrays, w: Array, gradient: Array, on_limit: NDArray[np.bool_]) -> None:
    """Hold the sections at their limit for which bending further would reduce the cost."""
    for i in range(len(on_limit)):
        u, v = w[2 * i], w[2 * i + 1]
        at_limit = math.hypot(u, v) >= AT_LIMIT * arm.bend_limit[i]
        on_limit[i] = at_limit and gradient[2 * i] * u + gradient[2 * i + 1] * v < 0.0


@compiled
def _directions(w: Array, on_limit: NDArray[np.bool_]) -> Array:
    """Directions (n_free, 2 n_sections) of motion: u and v of free sections, along the limit of held ones."""
    n_held = np.sum(on_limit)
    basis = np.zeros((len(w) - n_held, len(w)))
    row = 0
    for i in range(len(on_limit)):
        if on_limit[i]:
            basis[row, 2 * i], basis[row, 2 * i + 1] = -w[2 * i + 1], w[2 * i]
            row += 1
        else:
            basis[row, 2 * i] = basis[row + 1, 2 * i + 1] = 1.0
            row += 2
    return basis


@compiled
def _move(w: Array, step: Array, on_limit: NDArray[np.bool_]) -> None:
    """Move ``w`` in place by ``step`` (n_free,) [rad]; a held section moves along its limit."""
    largest = np.max(np.abs(step))
    scale = 1.0 if largest < _LARGEST_STEP else _LARGEST_STEP / largest
    row = 0
    for i in range(len(on_limit)):
        if on_limit[i]:
            c, s = math.cos(scale * step[row]), math.sin(scale * step[row])
            u, v = w[2 * i], w[2 * i + 1]
            w[2 * i], w[2 * i + 1] = c * u - s * v, s * u + c * v
            row += 1
        else:
            w[2 * i] += scale * step[row]
            w[2 * i + 1] += scale * step[row + 1]
            row += 2


@merged
def _hessian(
    arm: ArmArrays,
    target: TargetArrays,
    w: Array,
    on_limit: NDArray[np.bool_],
    basis: Array,
    error: Array,
    jacobian: Array,
) -> Array:
    """Hessian (n_free, n_free) of the cost in the free directions, by central differences of the gradient."""
    n_free = len(basis)
    hessian = np.empty((n_free, n_free))
    for j in range(n_free):
        step = np.zeros(n_free)
        step[j] = _DIFFERENCE
        ahead, behind = w.copy(), w.copy()
        _move(ahead, step, on_limit)
        _move(behind, -step, on_limit)
        ahead_gradient = _directions(ahead, on_limit) @ _cost_and_gradient(arm, target, ahead, error, jacobian)[1]
        behind_gradient = _directions(behind, on_limit) @ _cost_and_gradient(arm, target, behind, error, jacobian)[1]
        hessian[:, j] = (ahead_gradient - behind_gradient) / (2.0 * _DIFFERENCE)
    return 0.5 * (hessian + hessian.T)


@merged
def nearest_of(arm: ArmArrays, target: TargetArrays, ends: Array, w: Array, n_tries: int) -> tuple[int, bool]:
    """Fill ``w`` with the nearest pose that descents find from the first of ``ends`` and the ``n_tries`` best.

    Of similar ends only one is tried. The first end, from a warm start, wins over others that are no nearer, so that a
    moving arm does not jump.

    Returns:
        Iterations, and whether the answer is a minimum.
    """
    order = np.argsort(ends[:, 0])
    best = np.inf
    iterations, settled = 0, False
    error, jacobian = np.empty(target.n_rows), np.empty((6, len(w)))
    n_tried = 0
    for k in range(-1, len(ends)):
        row = 0 if k < 0 else order[k]
        if ends[row, 0] == np.inf or n_tried > n_tries:
            continue
        if k > 0 and _is_like(ends[row], ends[order[k - 1]]):
            continue
        n_tried += 1
        candidate = ends[row, 1:].copy()
        spent, is_minimum = descend_to_nearest(arm, target, candidate)
        iterations += spent
        cost = _cost_and_gradient(arm, target, candidate, error, jacobian)[0]
        if cost < (1.0 - _NEARER) * best:
            best, settled = cost, is_minimum
            w[:] = candidate
    return iterations, settled


@merged
def _is_like(end: Array, other: Array) -> bool:
    """Return whether two ends of descents, each a squared error and a configuration, lead to an equivalent pose."""
    difference = abs(end[0] - other[0])
    way = 0.0
    for k in range(1, len(end)):
        way = max(way, abs(end[k] - other[k]))
    return difference <= _EQUAL * end[0] or (difference <= _ALIKE * end[0] and way < _NEIGHBOURS)

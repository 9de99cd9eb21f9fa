"""The compiled solver's entry point: many targets in one call, each answered with a status."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import BEND_LIMIT, CONTACT, ArmArrays, arrays_of
from continuum.kinematics.compiled.equations import argument, entry_point, merged
from continuum.kinematics.compiled.limits import is_within
from continuum.kinematics.compiled.nearest import nearest_of
from continuum.kinematics.compiled.redundancy import slide_towards
from continuum.kinematics.compiled.search import n_ends, search
from continuum.kinematics.compiled.task import FAR, TargetArrays, distance_to, evaluate, target_of
from continuum.kinematics.ik_result import IkStatus

FIRST, NEAR_START, LEAST_BENDING, LESS_BENDING = 0, 1, 2, 3
"""Objectives of the redundancy; the last reduces the bend only within the neighbourhood of the start."""
COLD, WARM, FOLLOW = 0, 1, 2
"""Starts: far from the solution; near the solution; for each target, the solution of the previous one."""

_SOLVED, _LIMIT_REACHED = int(IkStatus.SOLVED), int(IkStatus.LIMIT_REACHED)
_UNREACHABLE, _NO_CONVERGENCE = int(IkStatus.UNREACHABLE), int(IkStatus.NO_CONVERGENCE)
_COLD, _WARM = argument(False), argument(True)
_N_NEIGHBOURHOODS = 12  # neighbourhoods in the search for the least bent solution
_N_NEAREST = 4  # ends of descents from which the search for the nearest pose starts ...
_RESTARTS_PER_NEAREST = 16  # ... and one more for this many restarts


@merged
def answer(
    arm: ArmArrays,
    unlimited: ArmArrays,
    target: TargetArrays,
    w: Array,
    is_warm: bool,
    tolerance: float,
    objective: int,
    postures: Array,
) -> tuple[int, int, float, float]:
    """Solve for one target from ``w`` (2 n_sections,) [rad], and overwrite ``w`` with the solution.

    Returns:
        Status, iterations, distance [m] and angle [rad].
    """
    begin, nothing = w.copy(), np.zeros(len(arm.b))
    ends = np.empty((n_ends(postures), 1 + len(w)))
    iterations, distance, angle, solved = search(arm, target, w, is_warm, tolerance, postures, nothing, ends)
    error, jacobian = np.empty(target.n_rows), np.empty((6, len(w)))
    status = _SOLVED
    if not solved:
        spent, settled = nearest_of(arm, target, ends, w, _N_NEAREST + len(postures) // _RESTARTS_PER_NEAREST)
        iterations += spent
        distance, angle = evaluate(arm, target, w, error, jacobian)
        if distance > tolerance or angle > tolerance:
            status = _UNREACHABLE if settled else _NO_CONVERGENCE
            beyond = w.copy()
            spent, _, _, within_reach = search(
                unlimited, target, beyond, _WARM, tolerance, postures, arm.bend_limit, ends
            )
            iterations += spent
            if within_reach:
                status = _LIMIT_REACHED
                if is_within(beyond, arm.bend_limit):
                    status = _SOLVED
                    w[:] = beyond
    if status == _SOLVED and objective == NEAR_START:
        iterations += slide_towards(arm, target, w, begin, tolerance)
    elif status == _SOLVED and objective == LESS_BENDING:
        iterations += slide_towards(arm, target, w, np.zeros_like(w), tolerance)
    elif status == _SOLVED and objective == LEAST_BENDING:
        iterations += _least_bent(arm, target, w, tolerance, postures, ends)
    elif solved:
        return _SOLVED, iterations, distance, angle
    distance, angle = evaluate(arm, target, w, error, jacobian)
    return status, iterations, distance, angle


@merged
def _least_bent(arm: ArmArrays, target: TargetArrays, w: Array, tolerance: float, postures: Array, ends: Array) -> int:
    """Move the solution ``w`` in place to the least bent one of several neighbourhoods; return the iterations."""
    straight, nothing = np.zeros_like(w), np.zeros(len(arm.b))
    iterations = slide_towards(arm, target, w, straight, tolerance)
    if len(arm.b) == 1:
        return iterations
    for k in range(min(_N_NEIGHBOURHOODS, len(postures))):
        other = straight.copy()
        for i in range(len(other)):
            other[i] = arm.bend_limit[i // 2] * postures[k, i]
        spent, _, _, solved = search(arm, target, other, _COLD, tolerance, postures[:0], nothing, ends)
        iterations += spent
        if solved:
            iterations += slide_towards(arm, target, other, straight, tolerance)
            if np.sum(other * other) < np.sum(w * w):
                w[:] = other
    return iterations


@entry_point
def run_solver(
    table: Array,
    weight: float,
    rows: Array,
    w: Array,
    start: int,
    tolerance: float,
    objective: int,
    postures: Array,
    numbers: Array,
) -> None:
    """Solve for `Targets.rows` from ``w`` (n, 2 n_sections) in place; fill ``numbers`` (n, 4) as `answer` returns."""
    arm, unlimited = arrays_of(table, table[BEND_LIMIT]), arrays_of(table, table[CONTACT])
    for k in range(len(rows)):
        target = target_of(rows[k], weight)
        wish = objective
        if start == FOLLOW and k > 0:
            w[k] = w[k - 1]
            if objective == LEAST_BENDING:
                wish = LESS_BENDING  # no other neighbourhoods, so that the motion has no jumps
        status, iterations, distance, angle = answer(
            arm, unlimited, target, w[k], start != COLD, tolerance, wish, postures
        )
        if distance > 0.5 * FAR * weight:
            distance = distance_to(arm, w[k], rows[k])
        numbers[k, 0], numbers[k, 1], numbers[k, 2], numbers[k, 3] = status, iterations, distance, angle

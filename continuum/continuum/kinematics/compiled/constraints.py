"""Constraints on a solution: the conditions of the target and the active bend limits.

A normal is the gradient of a condition with respect to the coordinates. At the solution nearest to a reference, the
vector to the reference is a sum of normals. The multipliers of the bend limits push against the limits and never pull
(Karush, Kuhn and Tucker).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.equations import compiled, merged
from continuum.kinematics.compiled.limits import AT_LIMIT, pull_within
from continuum.kinematics.compiled.task import TargetArrays, evaluate, squared

LIMIT_ROWS = 6
"""Row of the first section's bend limit among the normals; the target's normals precede it."""

_DEPENDENT = 1e-10  # smallest linearly independent fraction of a normal that counts
_AT_ONCE = 1e-2  # a limit within this fraction of a step is met at once
_EXACT = 1e-13  # target accuracy of distance [m] and angle [rad]: a larger error would count as a gain
_MOST_RESTORATIONS = 10
_OUTWARD = 1e-12  # smallest push beyond a limit that counts [rad]


class Conditions(NamedTuple):
    """Work space that the functions below fill and read.

    Attributes:
        held: whether each section is held at its limit, (n_sections,).
        error: error of the tip to the target, (n_rows,) [m].
        normals: (6 + n_sections, 2 n_sections): those of the target, then those of the limits. Rows of conditions that
            the target does not set, and of limits that are not held, are zero.
        multipliers: multipliers of the normals, (6 + n_sections,).
        basis: (2 n_sections, 2 n_sections), orthonormal rows; the first ones span the normals.
        source: row of the normal from which each of the first basis rows was made, (2 n_sections,).
    """

    held: NDArray[np.bool_]
    error: Array
    normals: Array
    multipliers: Array
    basis: Array
    source: NDArray[np.int64]


@compiled
def no_conditions(n_sections: int, n_rows: int) -> Conditions:
    """Allocate the conditions of an arm and a target; no section is held."""
    size, n_normals = 2 * n_sections, LIMIT_ROWS + n_sections
    return Conditions(
        np.zeros(n_sections, np.bool_),
        np.empty(n_rows),
        np.empty((n_normals, size)),
        np.empty(n_normals),
        np.empty((size, size)),
        np.empty(size, np.int64),
    )


@compiled
def fill_normals(arm: ArmArrays, target: TargetArrays, w: Array, conditions: Conditions) -> tuple[float, float]:
    """Fill the error and the normals, including those of held limits, at ``w`` (2 n_sections,) [rad].

    Returns:
        Distance [m] and angle [rad] from the tip to the target.
    """
    held, normals = conditions.held, conditions.normals
    miss = evaluate(arm, target, w, conditions.error, normals)
    normals[target.n_rows :] = 0.0
    for i in range(len(held)):
        if held[i]:
            theta = math.hypot(w[2 * i], w[2 * i + 1])
            normals[LIMIT_ROWS + i, 2 * i] = w[2 * i] / theta
            normals[LIMIT_ROWS + i, 2 * i + 1] = w[2 * i + 1] / theta
    return miss


@merged
def press(arm: ArmArrays, target: TargetArrays, w: Array, gradient: Array, conditions: Conditions) -> int:
    """Find the limits that are active against a descent along ``gradient`` (2 n_sections,), and their multipliers.

    Fills all of ``conditions``: the multipliers bring the sum of the normals nearest to the gradient, and the remaining
    basis rows span the free directions.

    Returns:
        Number of basis rows that span the normals.
    """
    conditions.held[:] = False
    rank = 0
    for _ in range(4 * len(arm.b) + 1):
        rank = press_on_held(arm, target, w, gradient, conditions)
        if not _change_held(arm, w, gradient, rank, conditions):
            break
    return rank


@compiled
def press_on_held(arm: ArmArrays, target: TargetArrays, w: Array, gradient: Array, conditions: Conditions) -> int:
    """As `press`, for limits that are chosen already, even if some of them pull."""
    fill_normals(arm, target, w, conditions)
    rank = _span(conditions)
    _fill_multipliers(gradient, rank, conditions)
    _complete(conditions.basis, rank)
    return rank


@merged
def _change_held(arm: ArmArrays, w: Array, gradient: Array, rank: int, conditions: Conditions) -> bool:
    """Release the limit that pulls most, or else hold the one that is pushed most; return False if neither exists."""
    held, multipliers, basis = conditions.held, conditions.multipliers, conditions.basis
    push = -gradient
    for i in range(rank):
        along = inner(basis[i], push)
        for k in range(len(push)):
            push[k] -= along * basis[i, k]
    let_go, hold = -1, -1
    most_pull, most_push = 0.0, _OUTWARD
    for i in range(len(held)):
        u, v = w[2 * i], w[2 * i + 1]
        theta = math.hypot(u, v)
        if held[i]:
            if multipliers[LIMIT_ROWS + i] > most_pull:
                let_go, most_pull = i, multipliers[LIMIT_ROWS + i]
        elif theta >= AT_LIMIT * arm.bend_limit[i]:
            outward = (push[2 * i] * u + push[2 * i + 1] * v) / theta
            if outward > most_push:
                hold, most_push = i, outward
    if let_go >= 0:
        held[let_go] = False
    elif hold >= 0:
        held[hold] = True
    return let_go >= 0 or hold >= 0


@compiled
def way_to_limits(arm: ArmArrays, w: Array, step: Array, held: NDArray[np.bool_]) -> tuple[float, bool]:
    """Return the fraction of ``step`` (2 n_sections,) [rad], at most 1, at which a section reaches its limit.

    A section that is at its limit already and would exceed it at once becomes held; the returned flag reports this.
    """
    part, changed = 1.0, False
    for i in range(len(held)):
        if held[i]:
            continue
        x, y, limit = step[2 * i], step[2 * i + 1], arm.bend_limit[i]
        along = w[2 * i] * x + w[2 * i + 1] * y
        theta_squared = w[2 * i] * w[2 * i] + w[2 * i + 1] * w[2 * i + 1]
        slack = max(limit * limit - theta_squared, 0.0)
        square = x * x + y * y
        root = math.sqrt(along * along + square * slack)
        # The form of the quadratic equation's root that has no cancellation.
        reach = slack / (root + along) if along > 0.0 else (root - along) / square if square > 0.0 else np.inf
        if reach < _AT_ONCE and theta_squared >= (AT_LIMIT * limit) ** 2:
            held[i] = changed = True
        part = min(part, reach)
    return part, changed


@compiled
def restore(arm: ArmArrays, target: TargetArrays, w: Array, conditions: Conditions) -> tuple[float, float]:
    """Move ``w`` (2 n_sections,) [rad] in place onto the target and the held limits, by shortest Newton steps.

    Sections that a step moves beyond their limit become held. The function reads ``conditions.held`` and overwrites all
    of ``conditions``.

    Returns:
        Distance [m] and angle [rad] from the tip to the target.
    """
    held, normals, basis, source = conditions.held, conditions.normals, conditions.basis, conditions.source
    short, parts = np.zeros(len(normals)), np.empty(len(w))
    distance, angle = np.inf, np.inf
    for k in range(_MOST_RESTORATIONS + 1):
        distance, angle = fill_normals(arm, target, w, conditions)
        short[: target.n_rows] = conditions.error
        largest = max(distance, angle)
        for i in range(len(held)):
            if held[i]:
                short[LIMIT_ROWS + i] = arm.bend_limit[i] - math.hypot(w[2 * i], w[2 * i + 1])
                largest = max(largest, abs(short[LIMIT_ROWS + i]))
        if largest <= _EXACT or k == _MOST_RESTORATIONS:
            break
        rank = _span(conditions)
        for i in range(rank):  # by substitution: a normal is orthogonal to later basis rows
            row = normals[source[i]]
            parts[i] = short[source[i]]
            for j in range(i):
                parts[i] -= inner(basis[j], row) * parts[j]
            parts[i] /= inner(basis[i], row)
        for i in range(rank):
            for c in range(len(w)):
                w[c] += parts[i] * basis[i, c]
        for i in range(len(held)):
            held[i] = held[i] or math.hypot(w[2 * i], w[2 * i + 1]) > arm.bend_limit[i]
    pull_within(arm, w)
    return distance, angle


@compiled
def _span(conditions: Conditions) -> int:
    """Fill the first rows of the basis from the normals and return their number."""
    normals, basis, source = conditions.normals, conditions.basis, conditions.source
    rank = 0
    for row in range(len(normals)):
        if _append(basis, rank, normals[row], _DEPENDENT):
            source[rank] = row
            rank += 1
    return rank


@merged
def _complete(basis: Array, rank: int) -> None:
    """Fill the rows of ``basis`` (k, k) from ``rank`` on, so that it spans everything."""
    size = len(basis)
    axis = np.zeros(size)
    for k in range(size):
        if rank < size:
            axis[k] = 1.0
            if _append(basis, rank, axis, 0.5 / math.sqrt(size)):  # so small that the axes give all missing rows
                rank += 1
            axis[k] = 0.0


@compiled
def _append(basis: Array, count: int, row: Array, least: float) -> bool:
    """Append the component of ``row`` that is orthogonal to the first ``count`` rows of ``basis``, normalised.

    Return False if that component is less than ``least`` of ``row``. Uses the Gram-Schmidt method with
    reorthogonalisation, so that the rows are orthogonal to rounding.
    """
    length = math.sqrt(squared(row))
    if count == len(basis) or length == 0.0:
        return False
    new = basis[count]
    new[:] = row
    before, left = math.inf, length
    while left < 0.7 * before and left > least * length:
        before = left
        for i in range(count):
            along = inner(basis[i], new)
            for k in range(len(new)):
                new[k] -= along * basis[i, k]
        left = math.sqrt(squared(new))
    if left <= least * length:
        return False
    new /= left
    return True


@merged
def _fill_multipliers(gradient: Array, rank: int, conditions: Conditions) -> None:
    """Fill the multipliers by back substitution: a normal is orthogonal to later basis rows."""
    normals, multipliers = conditions.normals, conditions.multipliers
    basis, source = conditions.basis, conditions.source
    multipliers[:] = 0.0
    for i in range(rank - 1, -1, -1):
        total = inner(basis[i], gradient)
        for j in range(i + 1, rank):
            total -= inner(basis[i], normals[source[j]]) * multipliers[source[j]]
        multipliers[source[i]] = total / inner(basis[i], normals[source[i]])


@compiled
def inner(a: Array, b: Array) -> float:
    """Inner product of two vectors of one length."""
    total = 0.0
    for k in range(len(a)):
        total += a[k] * b[k]
    return total

"""Search for a configuration that solves a target: descents from several starts until one converges."""

from __future__ import annotations

import math

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.descent import descend
from continuum.kinematics.compiled.equations import argument, compiled, merged
from continuum.kinematics.compiled.limits import is_within
from continuum.kinematics.compiled.task import TargetArrays
from continuum.kinematics.compiled.two_sections import MOST_CANDIDATES, fill_candidates
from continuum.kinematics.fabrikc import LARGEST_BEND, fabrikc
from continuum.kinematics.ik_target import POSITION
from continuum.kinematics.section import configuration_entries

_FABRIKC_PASSES = argument(1)
_MAX_ITERATIONS = argument(40)  # of a descent
_DAMPING = 1e-3  # at the start of a descent


def start_postures(n_sections: int, count: int) -> Array:
    """Return start postures (count, 2 n_sections) in fractions of the bend limit, from a low-discrepancy sequence.

    The sequence is deterministic, after Roberts's generalisation of the golden ratio: with g the root of
    g^(d+1) = g + 1, coordinate j advances by g^-j. In every third posture all sections are at their limit, and in
    another third about half of them are: searches from elsewhere rarely find a solution at several limits.
    """
    d = 2 * n_sections
    g = 2.0
    for _ in range(60):
        g = (1.0 + g) ** (1.0 / (d + 1.0))
    numbers, strides = np.arange(1, count + 1)[:, None], g ** -np.arange(1.0, d + 1.0)
    points = (0.5 + numbers * strides) % 1.0
    bend, azimuth = points[:, 0::2], 2.0 * np.pi * points[:, 1::2]
    bend[(numbers % 3 == 0) | ((numbers % 3 == 2) & (bend < 0.5))] = 1.0
    return np.stack([bend * np.cos(azimuth), bend * np.sin(azimuth)], axis=-1).reshape(count, d)


@merged
def _point_at(arm: ArmArrays, position: Array, w: Array) -> None:
    """Solve an arm of one section in closed form: Eq. 5 in the frame of the section's base."""
    c, s = arm.cos_twist[0], arm.sin_twist[0]
    x, y = c * position[0] + s * position[1], c * position[1] - s * position[0]
    w[0], w[1] = configuration_entries(x, y, position[2])


@compiled
def n_ends(postures: Array) -> int:
    """Return the largest number of descents."""
    return 2 + MOST_CANDIDATES + len(postures)


@compiled
def search(
    arm: ArmArrays,
    target: TargetArrays,
    w: Array,
    is_warm: bool,
    tolerance: float,
    postures: Array,
    searched: Array,
    ends: Array,
) -> tuple[int, float, float, bool]:
    """Solve from ``w`` (2 n_sections,) [rad], then from the start postures in turn, and overwrite ``w``.

    One pass of FABRIKc before a descent selects the right branch of solutions; for a single section Eq. 5 is the
    solution. A warm start, which is near the solution, is first tried without either.

    ``searched`` (n_sections,) are bends [rad] within which an earlier search has failed; zero in the first search.

    ``ends`` (n_ends(postures), 1 + 2 n_sections) receives the ends of the descents that did not converge, each row the
    squared error [m2] and the configuration; the search for the nearest pose starts from them.

    Returns:
        Iterations of all descents, distance [m], angle [rad], and whether the target is solved.
    """
    begin, legs = w.copy(), np.full(len(arm.b), LARGEST_BEND)
    iterations = 0
    first = 0 if is_warm else 1
    n_candidates, candidates = 0, np.empty((MOST_CANDIDATES, 4))
    for k in range(first, len(ends)):
        if k == 2 and len(arm.b) == 2 and target.n_rows > POSITION:
            n_candidates = fill_candidates(arm, target, candidates)
        if k < 2:
            w[:] = begin
        elif k < 2 + n_candidates:
            w[:] = candidates[k - 2]
        elif k < 2 + n_candidates + len(postures):
            _stand(arm, postures[k - 2 - n_candidates], searched, k % len(arm.b), w)
        else:
            break
        if k == 1 and len(arm.b) == 1:
            _point_at(arm, target.position, w)
        elif (k == 1 or k >= 2 + n_candidates) and is_within(w, legs):
            fabrikc(arm, target, w, tolerance, _FABRIKC_PASSES)
        spent, distance, angle, solved = descend(arm, target, w, tolerance, _MAX_ITERATIONS, _DAMPING)
        iterations += spent
        if solved:
            break
        if k == first:
            ends[:, 0] = np.inf
        ends[k, 0] = distance * distance + (target.weight * angle) ** 2
        ends[k, 1:] = w
    return iterations, distance, angle, solved


@merged
def _stand(arm: ArmArrays, posture: Array, searched: Array, beyond: int, w: Array) -> None:
    """Fill ``w`` with a ``posture`` in which section ``beyond`` bends more than its ``searched`` bend."""
    for i in range(len(searched)):
        part = math.hypot(posture[2 * i], posture[2 * i + 1])
        least = searched[i] if i == beyond else 0.0
        bend = least + part * (arm.bend_limit[i] - least)
        w[2 * i], w[2 * i + 1] = bend / part * posture[2 * i], bend / part * posture[2 * i + 1]

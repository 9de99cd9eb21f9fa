"""All solutions of two sections for a position and a direction of the tip, by a search over one variable.

With the two virtual legs of every section (see :mod:`continuum.kinematics.fabrikc`) of length s_i, the tip of two
sections with the tangents t0 at the base, t1 where they meet and t2 at the tip is at

    p = s_1 t_0 + (s_1 + s_2) t_1 + s_2 t_2.

A bend of the first section gives s_1 and t_0 . t_1; the scalar product of the equation with t_0 then gives s_2, and the
equation itself gives t_1. Where t_1 has unit length there may be a solution: the bend of the second section follows
from t_1 . t_2 and exceeds half a turn where s_2 is negative. The search steps through the bend of the first section;
the descent refines its results.
"""

from __future__ import annotations

import math

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.equations import compiled, merged
from continuum.kinematics.compiled.task import TargetArrays
from continuum.kinematics.fabrikc import configuration_from_tangents, leg_length

MOST_CANDIDATES = 12
_N_STEPS = 360
_N_BISECTIONS = 12


@merged
def fill_candidates(arm: ArmArrays, target: TargetArrays, candidates: Array) -> int:
    """Fill ``candidates`` (MOST_CANDIDATES, 4) [rad] with configurations near solutions; return their number."""
    tangent = np.empty(3)
    largest = min(arm.bend_limit[0], 2.0 * math.pi)
    step = largest / _N_STEPS
    count = 0
    before = last = np.inf
    for k in range(_N_STEPS + 1):
        bend = min((k + 0.5) * step, largest)
        excess, _ = _excess(arm, target, bend, tangent)
        found = -1.0
        if last * excess < 0.0:
            low, high = bend - step, bend
            for _ in range(_N_BISECTIONS):
                found = 0.5 * (low + high)
                if _excess(arm, target, found, tangent)[0] * excess < 0.0:
                    low = found
                else:
                    high = found
        elif abs(last) < abs(before) and abs(last) <= abs(excess):
            found = bend - step  # the length has its closest approach to one
        before, last = last, excess
        if found >= 0.0 and count < len(candidates):
            _, leg = _excess(arm, target, found, tangent)
            _fill_configuration(arm, target, found, leg, tangent, candidates[count])
            count += 1
    return count


@compiled
def _excess(arm: ArmArrays, target: TargetArrays, bend: float, tangent: Array) -> tuple[float, float]:
    """Return the excess of |t_1|^2 over one at a ``bend`` [rad] of the first section, and s_2 [m].

    Fills ``tangent`` (3,) with t_1.
    """
    first = leg_length(bend, arm.b[0], arm.n_joints[0])
    end = target.rotation[:, 2]
    second = (target.position[2] - first * (1.0 + math.cos(bend))) / (math.cos(bend) + end[2])
    for i in range(3):
        tangent[i] = (target.position[i] - second * end[i]) / (first + second)
    tangent[2] -= first / (first + second)
    return tangent[0] ** 2 + tangent[1] ** 2 + tangent[2] ** 2 - 1.0, second


@merged
def _fill_configuration(
    arm: ArmArrays, target: TargetArrays, bend: float, second: float, tangent: Array, w: Array
) -> None:
    tangents = np.empty((2, 3))
    tangents[0] = tangent
    tangents[1] = target.rotation[:, 2]
    configuration_from_tangents(arm, tangents, w)
    if bend > math.pi:
        _bend_the_long_way(w[:2])
    if second < 0.0:
        _bend_the_long_way(w[2:])


@compiled
def _bend_the_long_way(w: Array) -> None:
    """Replace ``w`` (2,) [rad] by the bend that gives the same rotation in the opposite direction."""
    theta = math.hypot(w[0], w[1])
    if theta > 0.0:
        w *= (theta - 2.0 * math.pi) / theta

"""One way to step in time: implicit midpoint rule, linear in the step, with Moreau's impulses of dry friction.

With the predicted middle of a step of length h, from the change dv_p of the rates in the step before,

    q_p = q + h/2 v + h/4 dv_p,    v_p = v + dv_p / 2,    q+ = q + h (v + v+) / 2,    v+ = v + dv,

the step solves, with h G = h/2 D + h^2/4 K for the stiff terms of Eq. 12,

    (M(q_p) + h G) dv = h f(q_p, v_p) + h G dv_p - h sum_k T_k(v+) dL_k/dq - h c Sgn(v+),

Sgn being the set-valued sign (Moreau 1988; Acary and Brogliato, Numerical Methods for Nonsmooth Dynamical Systems,
2008, ch. 10): a joint sticks with v+ = 0 as long as the impulse that this takes is within h c, c being the dry friction
of Eq. 13. Sticking is exact and needs no small steps. The modes (sticks, slips forward, slips backward) are found by
an active set that starts from the modes of the step before. The friction of cables, Eq. 15, is linearised about the
rates that are predicted for the end of the step, v + dv_p, where it is a damping that may be arbitrarily stiff. Of
the derivative of a cable's torque only the symmetric part is implicit: what a hole takes from the tension depends on
the slip there, and little on that at the holes before it.

Linear springs and dampers cancel from the prediction, so that they are integrated by the implicit midpoint rule, which
keeps their energy; all else but the friction of cables, which is that at the end of the step, is of second order in h
while the modes stay.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from continuum.arrays import Array, Booleans, Integers
from continuum.dynamics.spatial.cable_paths import SATURATED, Cables, Paths, Pull, new_paths, new_pull, trace
from continuum.dynamics.spatial.chain import (
    Chain,
    Moving,
    Placed,
    inverse_dynamics,
    mass_matrix,
    new_moving,
    new_placed,
    place,
)
from continuum.dynamics.spatial.compiling import entry_point, inner, merged
from continuum.dynamics.spatial.linear_systems import factor, solve

COMPLETE, NOT_FINITE, NO_MODES = 0, 1, 2
"""Status of a simulation: done; a state is not finite, or the mass matrix is singular; no modes satisfy their laws."""

_PATIENCE = 10
"""Active sets without fewer violations, in which all joints that violate their law change their mode; then one joint at
a time, the first one, until there are fewer: this ends, as the matrix is positive definite (block pivoting with Murty's
rule: Portugal, Judice and Vicente, Mathematics of Computation 63, 1994)."""
_MOST_SETS = 1_000_000
"""No arm needs so many, unless rounding leads in circles."""
_SLOW = 1e-12
"""Rate that is no slip in the wrong direction [rad/s]: rounding of a solution near 1 rad/s."""


class Joints(NamedTuple):
    """Springs and friction of the degrees of freedom (Eqs. 12, 13), (n,) each.

    Attributes:
        stiffness: K [N m/rad].
        rest: angle of the relaxed spring [rad].
        viscous: tau_mu [N m s/rad].
        coulomb: tau_c [N m].
        stribeck_gain: S.
        stribeck_speed: v_d [rad/s].
    """

    stiffness: Array
    rest: Array
    viscous: Array
    coulomb: Array
    stribeck_gain: Array
    stribeck_speed: Array


class State(NamedTuple):
    """State of the arm between two steps; a step overwrites it.

    Attributes:
        q: angles, (n,) [rad].
        v: rates, (n,) [rad/s].
        acceleration: that of the last step where it predicts the next one, else 0, (n,) [rad/s2].
        mode: -1, 0 or 1: slips backward, sticks, slips forward, (n,).
    """

    q: Array
    v: Array
    acceleration: Array
    mode: Integers


class Work(NamedTuple):
    """Storage of a step."""

    placed: Placed
    moving: Moving
    paths: Paths
    pull: Pull
    change: Array
    middle_q: Array
    middle_v: Array
    end_v: Array
    zero: Array
    torque: Array
    implicit: Array
    impulse: Array
    level: Array
    matrix: Array
    factor: Array
    right: Array
    step: Array
    slipping: Integers
    before: Integers
    wanted: Integers
    goes_on: Integers


@inner
def new_work(n: int, cables: Cables) -> Work:
    """Return storage for arms with ``n`` degrees of freedom and these cables."""
    integers = np.zeros(n, np.int64)
    return Work(
        new_placed(n), new_moving(n), new_paths(cables, n), new_pull(cables), np.empty(n), np.empty(n), np.empty(n),
        np.empty(n), np.zeros(n), np.empty(n), np.empty(n), np.empty(n), np.empty(n), np.empty((n, n)),
        np.empty((n, n)), np.empty(n), np.empty(n), integers, integers.copy(), integers.copy(), integers.copy(),
    )  # fmt: skip


def initial_state(joints: Joints, q: Array, v: Array) -> State:
    """Return the state at angles and rates (n,) without a step before it: joints at rest with dry friction stick."""
    slips = (np.abs(v) > _SLOW) | (joints.coulomb == 0.0)
    mode = np.where(slips, np.where(v >= 0.0, 1, -1), 0)
    return State(q.copy(), v.copy(), np.zeros(q.size), mode)


@merged
def step(
    chain: Chain, joints: Joints, cables: Cables, holds: Booleans, state: State, command: Array, drive: Array, h: float,
    work: Work,
) -> int:  # fmt: skip
    """Advance the state by one step.

    Args:
        chain, joints, cables: the arm.
        holds: whether the motor of each cable holds a length instead of a tension, (n_cables,).
        state: overwritten.
        command: tension [N] of each cable, or length [m] of the path that its motor allows, (n_cables,).
        drive: torque of each joint's drive, (n,) [N m].
        h: length of the step [s].
        work: storage.

    Returns:
        The status.
    """
    n = state.q.size
    q, v, mode, acceleration = state.q, state.v, state.mode, state.acceleration
    q_p, v_p, change, torque, matrix = work.middle_q, work.middle_v, work.change, work.torque, work.matrix
    implicit, impulse, level, end_v, before = work.implicit, work.impulse, work.level, work.end_v, work.before
    stiffness, rest, viscous, coulomb = joints.stiffness, joints.rest, joints.viscous, joints.coulomb
    gain, slow, rotor = joints.stribeck_gain, joints.stribeck_speed, chain.rotor
    for i in range(n):
        change[i] = h * acceleration[i]
        q_p[i] = q[i] + 0.5 * h * v[i] + 0.25 * h * change[i]
        v_p[i] = v[i] + 0.5 * change[i]
    place(chain, q_p, work.placed)
    inverse_dynamics(chain, work.placed, v_p, work.zero, work.moving, torque)
    mass_matrix(work.placed, matrix)
    for i in range(n):
        implicit[i] = 0.5 * h * viscous[i] + 0.25 * h * h * stiffness[i]
        matrix[i, i] += rotor[i] + implicit[i]
        still = torque[i] + stiffness[i] * (q_p[i] - rest[i]) + viscous[i] * v_p[i] - drive[i]
        impulse[i] = implicit[i] * change[i] - h * still
        level[i] = coulomb[i]
        if gain[i] != 0.0:
            level[i] *= 1.0 + gain[i] * np.exp(-((v_p[i] / slow[i]) ** 2))
        end_v[i] = v[i] + change[i]
        before[i] = mode[i]
    if cables.first.size > 1:
        trace(cables, chain.base, work.placed, work.paths)
    _add_cables(cables, holds, state, command, h, work)
    status = _solve_for_change(joints, state, h, work)
    if status != COMPLETE:
        return status
    for i in range(n):
        moved = end_v[i] - v[i]
        q[i] += h * (v[i] + 0.5 * moved)
        v[i] = end_v[i]
        goes_on = coulomb[i] == 0.0 or (
            # a predicted rate beyond zero would begin with the wrong friction
            mode[i] == before[i] and (v[i] + 0.5 * moved) * mode[i] > 0.0
        )
        work.goes_on[i] = 1 if goes_on else 0
        acceleration[i] = moved / h if goes_on else 0.0
        if not np.isfinite(q[i]):
            return NOT_FINITE
    return COMPLETE


@merged
def _solve_for_change(joints: Joints, state: State, h: float, work: Work) -> int:
    """Find modes and ``work.end_v`` that satisfy the step's equation and the laws of friction."""
    n = state.q.size
    mode, v, right, level, change, end_v = state.mode, state.v, work.right, work.level, work.step, work.end_v
    factors, slipping, matrix, wanted = work.factor, work.slipping, work.matrix, work.wanted
    least, patience = n + 1, _PATIENCE
    for _ in range(_MOST_SETS):
        n_slipping = 0
        for i in range(n):
            if mode[i] != 0:
                slipping[n_slipping] = i
                n_slipping += 1
        for x in range(n_slipping):
            i = slipping[x]
            total = right[i] - h * mode[i] * level[i]
            if n_slipping < n:
                for k in range(n):
                    if mode[k] == 0:
                        total += matrix[min(i, k), max(i, k)] * v[k]
            change[x] = total
            for y in range(x, n_slipping):
                factors[x, y] = matrix[i, slipping[y]]
        if not factor(factors, n_slipping):
            return NOT_FINITE
        solve(factors, change, n_slipping)
        for i in range(n):
            end_v[i] = 0.0
        for x in range(n_slipping):
            end_v[slipping[x]] = v[slipping[x]] + change[x]
        violations = _find_violations(joints, state, h, work)
        if violations == 0:
            return COMPLETE
        if violations < least:
            least, patience = violations, _PATIENCE
        else:
            patience -= 1
        for i in range(n):
            if wanted[i] != mode[i]:
                mode[i] = wanted[i]
                if patience < 0:
                    break
    return NO_MODES


@merged
def _find_violations(joints: Joints, state: State, h: float, work: Work) -> int:
    """Fill ``work.wanted`` with the modes that the laws of friction ask for; return how many are other ones."""
    n, number = state.q.size, 0
    modes, coulomb, v, end_v, right, level = state.mode, joints.coulomb, state.v, work.end_v, work.right, work.level
    matrix, wanted = work.matrix, work.wanted
    for i in range(n):
        mode = modes[i]
        wanted[i] = mode
        if coulomb[i] == 0.0:
            continue
        if mode != 0:
            if end_v[i] * mode < -_SLOW:
                wanted[i] = 0
        else:
            needed = right[i]  # impulse that would move the joint
            for k in range(n):
                needed -= matrix[min(i, k), max(i, k)] * (end_v[k] - v[k])
            if abs(needed) > h * level[i] * (1.0 + 1e-9):
                wanted[i] = 1 if needed > 0.0 else -1
        if wanted[i] != mode:
            number += 1
    return number


@merged
def _add_cables(cables: Cables, holds: Booleans, state: State, command: Array, h: float, work: Work) -> None:
    """Fill ``work.right`` with the impulses of joints and cables; add the cables' damping to the matrix.

    Hole k takes F_k = T_k (1 - exp(-mu phi_k s(w_k))) from the tension. Linearised about the slip w0, which is the one
    predicted for the end of the step, the tension of segment j at the end is

        T_j - sum_{k < j} D_k (w_k - w0_k),    D_k = dF_k/dw_k,    w_k = -sum_{l beyond k} dL/dq_l v+_l,

    so that the damping of the angles i, l in segments j(i) <= j(l) is dL/dq_i dL/dq_l sum_{k < j(i)} D_k. Where the
    slip turns within the step, w0 is zero: there the law is steepest, and the cable comes to rest instead of turning to
    and fro. The spring of a cable whose motor holds a length damps all pairs of angles alike.
    """
    n = state.q.size
    first, body, friction, steepness = cables.first, cables.body, cables.friction, cables.slope
    paths, pull, v, end_v, change = work.paths, work.pull, state.v, work.end_v, work.change
    gradient, length, bend = paths.gradient, paths.length, paths.bend
    slip, turns, tension, damping = pull.slip, pull.turns, pull.tension, pull.damping
    base, base_damping, right, impulse, matrix = pull.base, pull.base_damping, work.right, work.impulse, work.matrix
    for i in range(n):
        right[i] = impulse[i]
    for c in range(first.size - 1):
        begin, end, mu, steep = first[c], first[c + 1], friction[c], steepness[c]
        base[c], base_damping[c] = command[c], 0.0
        inmost, outmost = body[begin] + 1, body[end - 1] + 1
        offset = 0.0
        if holds[c]:
            stretch, rate, late = -command[c], 0.0, 0.0
            for k in range(begin + 1, end):
                stretch += length[k]
            for i in range(inmost, outmost):
                rate += 0.5 * gradient[c, i] * (v[i] + end_v[i])
                late += gradient[c, i] * change[i]
            pulled = cables.stiffness[c] * stretch + cables.damping[c] * rate
            if pulled > 0.0:
                base[c], base_damping[c] = pulled, 0.25 * h * cables.stiffness[c] + 0.5 * cables.damping[c]
                offset = -base_damping[c] * late
            else:
                base[c] = 0.0
        if base[c] <= 0.0:
            continue
        rubs = mu > 0.0
        if rubs:
            beyond, before = 0.0, 0.0
            for k in range(end - 1, begin, -1):
                turns[k] = beyond * before < 0.0
                slip[k] = 0.0 if turns[k] else beyond
                damping[k] = before  # the slip at the begin of the step, until the damping is known
                for i in range(body[k - 1] + 1, body[k] + 1):
                    beyond -= gradient[c, i] * end_v[i]
                    before -= gradient[c, i] * v[i]
        pulling, shared = base[c], base_damping[c]
        for k in range(begin + 1, end):
            tension[k] = pulling
            for i in range(body[k - 1] + 1, body[k] + 1):
                g = gradient[c, i]
                right[i] -= h * (pulling + offset) * g
                if shared != 0.0:
                    g *= h * shared
                    for j in range(i, outmost):
                        matrix[i, j] += g * gradient[c, j]
            if rubs and k < end - 1:
                x = steep * slip[k]
                before = damping[k]
                if abs(x) > SATURATED:
                    pulling *= np.exp(-mu * bend[k] if x > 0.0 else mu * bend[k])
                    damping[k] = 0.0
                else:
                    sign = np.tanh(x)
                    pulling *= np.exp(-mu * bend[k] * sign)
                    damping[k] = pulling * mu * bend[k] * steep * (1.0 - sign * sign)
                    shared += damping[k]
                    offset -= damping[k] * (before - slip[k])


@entry_point
def simulate(
    chain: Chain, joints: Joints, cables: Cables, holds: Booleans, state: State, durations: Array, steps: Integers,
    before: Array, after: Array, drive_before: Array, drive_after: Array, q_out: Array, v_out: Array,
) -> tuple[int, int]:  # fmt: skip
    """Advance over intervals in which commands and torques change linearly; write the state at the end of each.

    Args:
        chain, joints, cables, holds, state: as in `step`.
        durations: of the intervals, (n_intervals,) [s].
        steps: number of steps in each, (n_intervals,).
        before, after: commands at the begin and the end of each interval, (n_intervals, n_cables).
        drive_before, drive_after: torques of the drives, (n_intervals, n) [N m].
        q_out, v_out: results, (n_intervals, n) [rad, rad/s].

    Returns:
        The status, and the number of completed intervals.
    """
    n, n_cables = state.q.size, cables.first.size - 1
    work = new_work(n, cables)
    command, drive = np.empty(n_cables), np.empty(n)
    for row in range(durations.size):
        h = durations[row] / steps[row]
        for number in range(steps[row]):
            part = (number + 0.5) / steps[row]
            for c in range(n_cables):
                command[c] = before[row, c] + part * (after[row, c] - before[row, c])
            for i in range(n):
                drive[i] = drive_before[row, i] + part * (drive_after[row, i] - drive_before[row, i])
            status = step(chain, joints, cables, holds, state, command, drive, h, work)
            if status != COMPLETE:
                return status, row
        q_out[row] = state.q
        v_out[row] = state.v
    return COMPLETE, durations.size

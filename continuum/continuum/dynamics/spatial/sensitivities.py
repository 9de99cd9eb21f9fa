"""Derivatives of a step by its initial state and by values of the arm, in closed form while the modes stay.

The step solves r(dv; q_p, v_p, v, dv_p, p) = 0 on the joints that slip. Its derivative is one more solution with the
same matrix: a joint that sticks has the rate zero whatever changes. The columns of `Tangent` are carried along.

Values are those of the arm's arrays. `Free` lists directions in them, entry by entry: a factor on all springs has as
many entries as there are springs.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from continuum.arrays import Array, Booleans, Integers
from continuum.dynamics.spatial.cable_paths import SATURATED, Cables
from continuum.dynamics.spatial.chain import (
    Chain,
    Derivatives,
    derivatives,
    inverse_dynamics,
    inward_force,
    new_derivatives,
    shift_rates,
)
from continuum.dynamics.spatial.compiling import entry_point, inner
from continuum.dynamics.spatial.linear_systems import factor
from continuum.dynamics.spatial.time_stepping import COMPLETE, NOT_FINITE, Joints, State, Work, new_work, step
from continuum.dynamics.spatial.vectors import dot, inertia_times, motion_cross_force, motion_cross_motion

STIFFNESS, REST, VISCOUS, COULOMB, STRIBECK_GAIN, STRIBECK_SPEED, ROTOR, DRIVE = range(8)
"""Kinds of values of a joint: the index is its degree of freedom. DRIVE is an added torque [N m]."""
MASS, CENTER, INERTIA, OFFSET = range(8, 12)
"""Kinds of values of a body: the parts of CENTER and OFFSET are x, y, z, those of INERTIA xx, xy, xz, yy, yz, zz."""
GRAVITY, BASE = 12, 13
"""Kinds of values of the base: components of gravity [m/s2], and turns of the base about the world's axes [rad]."""
HOLE, CABLE_FRICTION, CABLE_SLOPE, CABLE_STIFFNESS, CABLE_DAMPING, COMMAND = range(14, 20)
"""Kinds of values of a hole (parts x, y, z), and of a cable. COMMAND is an added tension or length."""


class Free(NamedTuple):
    """Entries of directions: value (kind, item, part) changes by ``factor`` times the free quantity ``column``."""

    kind: Integers
    item: Integers
    part: Integers
    column: Integers
    factor: Array


class Tangent(NamedTuple):
    """Derivatives of a `State` by the free quantities, (n, n_free) each; a step overwrites them."""

    q: Array
    v: Array
    acceleration: Array


class TangentWork(NamedTuple):
    """Storage of a step of the tangent."""

    derivatives: Derivatives
    acceleration: Array
    torque: Array
    middle_q: Array
    middle_v: Array
    right: Array
    reduced: Array
    matrix: Array
    force: Array
    gradient: Array
    slip: Array
    predicted_slip: Array
    end_slip: Array
    bend: Array
    length: Array
    friction: Array
    steepness: Array
    logarithm: Array
    offset: Array


@inner
def new_tangent_work(n: int, cables: Cables, n_free: int) -> TangentWork:
    """Return storage for ``n`` degrees of freedom and ``n_free`` columns."""
    holes = cables.body.size
    of_freedoms = (np.empty((n, n_free)), np.empty((n, n_free)), np.empty((n, n_free)), np.empty((n, n_free)))
    of_holes = (np.empty((holes, n_free)), np.empty((holes, n_free)), np.empty((holes, n_free)))
    return TangentWork(
        new_derivatives(n), np.empty(n), np.empty(n), of_freedoms[0], of_freedoms[1], of_freedoms[2], of_freedoms[3],
        np.empty((n, n)), np.empty((n, 6, n_free)), np.empty((n, n_free)), np.empty(holes), of_holes[0], of_holes[1],
        of_holes[2], np.empty(n_free), np.empty(n_free), np.empty(n_free), np.empty(n_free), np.empty(n_free),
    )  # fmt: skip


@inner
def step_tangent(
    chain: Chain, joints: Joints, cables: Cables, holds: Booleans, free: Free, before: State, state: State,
    h: float, work: Work, tangent: Tangent, storage: TangentWork,
) -> bool:  # fmt: skip
    """Carry the tangent along with the step that has just been made.

    Args:
        chain, joints, cables, holds: the arm.
        free: directions in its values.
        before: state before the step.
        state: state after the step, with its modes.
        h: length of the step [s].
        work: storage of the step, as it left it.
        tangent: overwritten.
        storage: of this function.

    Returns:
        Whether the matrix could be factored.
    """
    n, n_free = tangent.q.shape
    q_p, v_p, right = storage.middle_q, storage.middle_v, storage.right
    by_q, by_v = storage.derivatives.by_q, storage.derivatives.by_v
    a = storage.acceleration
    for i in range(n):
        a[i] = (state.v[i] - before.v[i]) / h
        for k in range(n_free):
            q_p[i, k] = tangent.q[i, k] + 0.5 * h * tangent.v[i, k] + 0.25 * h * h * tangent.acceleration[i, k]
            v_p[i, k] = tangent.v[i, k] + 0.5 * h * tangent.acceleration[i, k]
    inverse_dynamics(chain, work.placed, work.middle_v, a, work.moving, storage.torque)
    derivatives(chain, work.placed, work.moving, storage.derivatives)
    for i in range(n):
        level_slope = 0.0
        if joints.stribeck_gain[i] != 0.0:
            x = work.middle_v[i] / joints.stribeck_speed[i]
            dry = joints.coulomb[i] * joints.stribeck_gain[i] * np.exp(-x * x)
            level_slope = -2.0 * x / joints.stribeck_speed[i] * dry * state.mode[i]
        along_q, along_v = joints.stiffness[i], joints.viscous[i] + level_slope
        for k in range(n_free):
            implicit = work.implicit[i] * h * tangent.acceleration[i, k]
            right[i, k] = implicit - h * (along_q * q_p[i, k] + along_v * v_p[i, k])
        for j in range(n):
            by_q_ij, by_v_ij = h * by_q[i, j], h * by_v[i, j]
            for k in range(n_free):
                right[i, k] -= by_q_ij * q_p[j, k] + by_v_ij * v_p[j, k]
    _by_values(chain, joints, free, before, state, h, work, storage)
    for c in range(cables.first.size - 1):
        _by_cable(chain, cables, holds, free, before, state, h, c, work, tangent, storage)
    return _solve(state, h, work, tangent, storage)


@inner
def _by_values(
    chain: Chain, joints: Joints, free: Free, before: State, state: State, h: float, work: Work, storage: TangentWork
) -> None:
    """Subtract the derivative of the residual by the values of joints, bodies and base."""
    right, force, derived, moving, placed = storage.right, storage.force, storage.derivatives, work.moving, work.placed
    n = right.shape[0]
    loads = False
    ten, six, first, second, scratch = np.empty(10), np.empty(6), np.empty(6), np.empty(6), np.empty(6)
    screw, still, upward = np.zeros(6), np.zeros(6), np.zeros(6)
    for k in range(3):
        upward[3 + k] = -chain.gravity[k]
    for e in range(free.kind.size):
        kind, i, part, column, size = free.kind[e], free.item[e], free.part[e], free.column[e], free.factor[e]
        if kind <= DRIVE:
            change = state.v[i] - before.v[i]
            excess = change - h * before.acceleration[i]
            x = work.middle_v[i] / joints.stribeck_speed[i]
            dip = np.exp(-x * x)
            if kind == STIFFNESS:
                value = h * (work.middle_q[i] - joints.rest[i]) + 0.25 * h * h * excess
            elif kind == REST:
                value = -h * joints.stiffness[i]
            elif kind == VISCOUS:
                value = h * work.middle_v[i] + 0.5 * h * excess
            elif kind == COULOMB:
                value = h * state.mode[i] * (1.0 + joints.stribeck_gain[i] * dip)
            elif kind == STRIBECK_GAIN:
                value = h * state.mode[i] * joints.coulomb[i] * dip
            elif kind == STRIBECK_SPEED:
                gain = joints.coulomb[i] * joints.stribeck_gain[i] * dip
                value = h * state.mode[i] * gain * 2.0 * x * x / joints.stribeck_speed[i]
            elif kind == ROTOR:
                value = change
            else:
                value = -h
            right[i, column] -= size * value
        elif kind <= INERTIA:
            if not loads:
                loads = True
                force[:] = 0.0
            _inertia_slope(chain, placed.rotation, placed.origin, kind, i, part, ten)
            inertia_times(ten, moving.acceleration[i], six)
            inertia_times(ten, moving.velocity[i], first)
            motion_cross_force(moving.velocity[i], first, second)
            for k in range(6):
                force[i, k, column] += size * (six[k] + second[k])
        elif kind == OFFSET:
            for k in range(3):
                screw[k] = 0.0
                screw[3 + k] = placed.rotation[i - 1, k, part] if i else chain.base[k, part]
            velocity = moving.velocity[i - 1] if i else still
            acceleration = moving.acceleration[i - 1] if i else upward
            shift_rates(velocity, acceleration, screw, first, second, scratch)
            inward_force(derived.composite[i], derived.coriolis[i], screw, first, second, moving.force[i], six, scratch)
            for j in range(n):
                value = dot(placed.screw[j], six) if j < i else dot(derived.BS[j], first) + dot(derived.IS[j], second)
                right[j, column] -= h * size * value
        elif kind <= BASE:
            screw[:] = 0.0
            if kind == GRAVITY:
                first[:] = 0.0
                first[3 + part] = -1.0
            else:
                screw[part] = 1.0
                motion_cross_motion(upward, screw, first)
            for j in range(n):
                right[j, column] -= h * size * dot(derived.IS[j], first)
    if loads:
        for j in range(n - 1, -1, -1):
            for k in range(6):
                for column in range(right.shape[1]):
                    if j < n - 1:
                        force[j, k, column] += force[j + 1, k, column]
                    right[j, column] -= h * placed.screw[j, k] * force[j, k, column]


@inner
def _inertia_slope(chain: Chain, R: Array, p: Array, kind: int, i: int, part: int, out: Array) -> None:
    """Derivative of the ten numbers of body i's inertia by its mass, or by a part of its centre or inertia."""
    c, d = np.empty(3), np.zeros(3)
    m = chain.mass[i]
    for a in range(3):
        c[a] = (
            p[i, a]
            + R[i, a, 0] * chain.center[i, 0]
            + R[i, a, 1] * chain.center[i, 1]
            + R[i, a, 2] * chain.center[i, 2]
        )
    out[:] = 0.0
    k = 4
    if kind == MASS:
        out[0] = 1.0
        square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2]
        for a in range(3):
            out[1 + a] = c[a]
            for b in range(a, 3):
                out[k] = (square if a == b else 0.0) - c[a] * c[b]
                k += 1
    elif kind == CENTER:
        for a in range(3):
            d[a] = R[i, a, part]
        square = 2.0 * (c[0] * d[0] + c[1] * d[1] + c[2] * d[2])
        for a in range(3):
            out[1 + a] = m * d[a]
            for b in range(a, 3):
                out[k] = m * ((square if a == b else 0.0) - c[a] * d[b] - d[a] * c[b])
                k += 1
    else:
        row = 0 if part < 3 else (1 if part < 5 else 2)
        col = part if part < 3 else (part - 2 if part < 5 else 2)
        for a in range(3):
            for b in range(a, 3):
                out[k] = R[i, a, row] * R[i, b, col]
                if row != col:
                    out[k] += R[i, a, col] * R[i, b, row]
                k += 1


@inner
def _by_cable(
    chain: Chain, cables: Cables, holds: Booleans, free: Free, before: State, state: State, h: float, c: int,
    work: Work, tangent: Tangent, storage: TangentWork,
) -> None:  # fmt: skip
    """Subtract the derivative of the impulse of cable c, but for its part by the change of the rates.

    The tension of segment j is T_j + e_j (see `time_stepping`): T_j as of the slips w0, whose logarithm is summed up
    along the cable, and e_j = b sum_l dL/dq_l (dv_l - dv_p,l) - sum_{k < j} D_k (w_k - w0_k).
    """
    begin, end, body, mu, steep = cables.first[c], cables.first[c + 1], cables.body, cables.friction[c], cables.slope[c]
    base = work.pull.base[c]
    if base <= 0.0:
        return
    paths, pull = work.paths, work.pull
    gradient, tension, bend, damping = paths.gradient, pull.tension, paths.bend, pull.damping
    right, turned, n_free = storage.right, storage.gradient, storage.right.shape[1]
    slip, slip_p, slip_e, bent = storage.slip, storage.predicted_slip, storage.end_slip, storage.bend
    by_mu, by_steep, logarithm, offset = storage.friction, storage.steepness, storage.logarithm, storage.offset
    _path_tangent(cables, chain.base, c, work, storage, free)
    for column in range(n_free):
        by_mu[column] = by_steep[column] = logarithm[column] = offset[column] = 0.0
    for e in range(free.kind.size):
        if free.item[e] == c and free.kind[e] == CABLE_FRICTION:
            by_mu[free.column[e]] += free.factor[e]
        elif free.item[e] == c and free.kind[e] == CABLE_SLOPE:
            by_steep[free.column[e]] += free.factor[e]
        elif free.item[e] == c and free.kind[e] == COMMAND:
            logarithm[free.column[e]] += free.factor[e] * (-cables.stiffness[c] if holds[c] else 1.0) / base
    extra = 0.0
    if holds[c]:
        extra = _by_held_length(cables, free, before, state, h, c, work, tangent, storage)
    if mu > 0.0:
        _slip_tangent(cables, before, state, h, c, work, tangent, storage)
    for k in range(begin + 1, end):
        pulling = tension[k] + extra
        for i in range(body[k - 1] + 1, body[k] + 1):
            g = gradient[c, i]
            for column in range(n_free):
                by_tension = tension[k] * logarithm[column] + offset[column]
                right[i, column] -= h * (by_tension * g + pulling * turned[i, column])
        if mu > 0.0 and k < end - 1:
            at, phi = pull.slip[k], bend[k]
            x = steep * at
            saturated = abs(x) > SATURATED
            s = np.sign(x) if saturated else np.tanh(x)
            flat = 0.0 if saturated else 1.0 - s * s  # d tanh
            beyond = slip[k] - at
            after = tension[k + 1]
            for column in range(n_free):
                moved = 0.0 if pull.turns[k] else slip_p[k, column]
                by_x = flat * (steep * moved + at * by_steep[column])  # of s
                rising = by_mu[column] * phi + mu * bent[k, column]  # of mu phi
                logarithm[column] -= rising * s + mu * phi * by_x
                by_slope = flat * by_steep[column] - 2.0 * steep * s * by_x  # of ds/dw
                by_damping = damping[k] * logarithm[column] + after * (rising * steep * flat + mu * phi * by_slope)
                offset[column] -= by_damping * beyond + damping[k] * (slip_e[k, column] - moved)
            extra -= damping[k] * beyond


@inner
def _by_held_length(
    cables: Cables, free: Free, before: State, state: State, h: float, c: int, work: Work, tangent: Tangent,
    storage: TangentWork,
) -> float:  # fmt: skip
    """Add the derivatives of the tension at the base of a cable whose motor holds a length; return the tension's e."""
    gradient, turned, base, slow = work.paths.gradient, storage.gradient, work.pull.base[c], work.pull.base_damping[c]
    stiffness, damping = cables.stiffness[c], cables.damping[c]
    logarithm, offset, whole = storage.logarithm, storage.offset, storage.length
    n_free = logarithm.size
    rate, late = 0.0, 0.0
    for column in range(n_free):
        logarithm[column] += stiffness * whole[column] / base
    for i in range(cables.body[cables.first[c]] + 1, cables.body[cables.first[c + 1] - 1] + 1):
        g, change = gradient[c, i], h * before.acceleration[i]
        middle, left = before.v[i] + 0.5 * change, state.v[i] - before.v[i] - change
        rate += g * middle
        late += g * left
        for column in range(n_free):
            d_change = h * tangent.acceleration[i, column]
            d_rate = turned[i, column] * middle + g * (tangent.v[i, column] + 0.5 * d_change)
            logarithm[column] += damping * d_rate / base
            offset[column] += slow * (turned[i, column] * left - g * d_change)
    for e in range(free.kind.size):
        if free.item[e] == c and free.kind[e] == CABLE_STIFFNESS:
            logarithm[free.column[e]] += free.factor[e] * (base - damping * rate) / stiffness / base
            offset[free.column[e]] += free.factor[e] * 0.25 * h * late
        elif free.item[e] == c and free.kind[e] == CABLE_DAMPING:
            logarithm[free.column[e]] += free.factor[e] * rate / base
            offset[free.column[e]] += free.factor[e] * 0.5 * late
    return float(slow * late)


@inner
def _slip_tangent(
    cables: Cables, before: State, state: State, h: float, c: int, work: Work, tangent: Tangent, storage: TangentWork
) -> None:
    """Slips of cable c at the end of the step, and derivatives of the predicted ones and of those at the end.

    The derivative of the slip at the end leaves out that of the change of the rates, which is still to be solved for.
    """
    begin, end, body, gradient, turned = (
        cables.first[c],
        cables.first[c + 1],
        cables.body,
        work.paths.gradient,
        storage.gradient,
    )
    slip, slip_p, slip_e, n_free = storage.slip, storage.predicted_slip, storage.end_slip, storage.right.shape[1]
    slip[end - 1] = 0.0
    for column in range(n_free):
        slip_p[end - 1, column] = slip_e[end - 1, column] = 0.0
    for k in range(end - 1, begin + 1, -1):
        slip[k - 1] = slip[k]
        for column in range(n_free):
            slip_p[k - 1, column], slip_e[k - 1, column] = slip_p[k, column], slip_e[k, column]
        for i in range(body[k - 1] + 1, body[k] + 1):
            g = gradient[c, i]
            predicted = before.v[i] + h * before.acceleration[i]
            slip[k - 1] -= g * state.v[i]
            for column in range(n_free):
                d_predicted = tangent.v[i, column] + h * tangent.acceleration[i, column]
                slip_p[k - 1, column] -= turned[i, column] * predicted + g * d_predicted
                slip_e[k - 1, column] -= turned[i, column] * state.v[i] + g * tangent.v[i, column]


@inner
def _path_tangent(cables: Cables, base: Array, c: int, work: Work, storage: TangentWork, free: Free) -> None:
    """Derivatives of gradients, bends and length of cable c by the free quantities."""
    begin, end, body = cables.first[c], cables.first[c + 1], cables.body
    paths, placed = work.paths, work.placed
    gradient, place, direction, length, bend = paths.gradient, paths.place, paths.direction, paths.length, paths.bend
    turned, bent, whole, q_p = storage.gradient, storage.bend, storage.length, storage.middle_q
    n_free = q_p.shape[1]
    u, w, across = np.empty(3), np.empty(3), np.empty(3)
    whole[:] = 0.0
    for k in range(begin, end):
        bent[k, :] = 0.0
    for k in range(begin + 1, end):
        for i in range(body[k - 1] + 1, body[k] + 1):
            turned[i, :] = 0.0
            for column in range(n_free):
                whole[column] += gradient[c, i] * q_p[i, column]
    for k in range(begin + 1, end):
        E, L = direction[k], length[k]
        for m in range(body[k - 1] + 1, body[k] + 1):
            _velocity(placed.screw, m, place, k, u)
            along = E[0] * u[0] + E[1] * u[1] + E[2] * u[2]
            for a in range(3):
                across[a] = (u[a] - along * E[a]) / L
            for i in range(body[k - 1] + 1, m + 1):
                _velocity(placed.screw, i, place, k, w)
                value = w[0] * across[0] + w[1] * across[1] + w[2] * across[2]
                # E . (omega_i x u_m)
                S = placed.screw[i]
                value += E[0] * (S[1] * u[2] - S[2] * u[1]) + E[1] * (S[2] * u[0] - S[0] * u[2])
                value += E[2] * (S[0] * u[1] - S[1] * u[0])
                for column in range(n_free):
                    turned[i, column] += value * q_p[m, column]
                    if i != m:
                        turned[m, column] += value * q_p[i, column]
            S = placed.screw[m]
            if k < end - 1 and bend[k] > 0.0:
                F = direction[k + 1]
                cosine = across[0] * F[0] + across[1] * F[1] + across[2] * F[2]
                cosine += E[0] * (S[1] * F[2] - S[2] * F[1]) + E[1] * (S[2] * F[0] - S[0] * F[2])
                cosine += E[2] * (S[0] * F[1] - S[1] * F[0])
                for column in range(n_free):
                    bent[k, column] -= cosine / np.sin(bend[k]) * q_p[m, column]
            if k > begin + 1 and bend[k - 1] > 0.0:
                B = direction[k - 1]
                cosine = across[0] * B[0] + across[1] * B[1] + across[2] * B[2]
                for column in range(n_free):
                    bent[k - 1, column] -= cosine / np.sin(bend[k - 1]) * q_p[m, column]
    for e in range(free.kind.size):
        kind, index, part, column, size = free.kind[e], free.item[e], free.part[e], free.column[e], free.factor[e]
        if kind == HOLE and begin <= index < end:
            on = body[index]
            for a in range(3):
                across[a] = size * (placed.rotation[on, a, part] if on >= 0 else base[a, part])
            _move_end(cables, c, index, 1.0, across, on + 1, column, work, storage)
            _move_end(cables, c, index + 1, -1.0, across, 0, column, work, storage)
        elif kind == OFFSET:
            for k in range(begin + 1, end):
                if body[k - 1] < index <= body[k]:
                    for a in range(3):
                        across[a] = size * (placed.rotation[index - 1, a, part] if index else base[a, part])
                    _move_end(cables, c, k, 1.0, across, index, column, work, storage)


@inner
def _move_end(
    cables: Cables, c: int, s: int, sign: float, moved: Array, fixed: int, column: int, work: Work,
    storage: TangentWork,
) -> None:  # fmt: skip
    """Add derivatives of gradients, bends and length of cable c as an end of its segment s moves by ``moved`` (3,).

    It is the outer end with ``sign`` 1 and the inner one with -1. The axes of the degrees of freedom before ``fixed``
    stay where they are, those of the others move along.
    """
    begin, end, body = cables.first[c], cables.first[c + 1], cables.body
    if s <= begin or s >= end:
        return
    paths, placed = work.paths, work.placed
    change, u = np.empty(3), np.empty(3)
    E, L = paths.direction[s], paths.length[s]
    along = E[0] * moved[0] + E[1] * moved[1] + E[2] * moved[2]
    storage.length[column] += sign * along
    for a in range(3):
        change[a] = sign * (moved[a] - along * E[a]) / L
    for i in range(body[s - 1] + 1, body[s] + 1):
        _velocity(placed.screw, i, paths.place, s, u)
        value = change[0] * u[0] + change[1] * u[1] + change[2] * u[2]
        if i < fixed:
            S = placed.screw[i]
            value += E[0] * (S[1] * moved[2] - S[2] * moved[1]) + E[1] * (S[2] * moved[0] - S[0] * moved[2])
            value += E[2] * (S[0] * moved[1] - S[1] * moved[0])
        storage.gradient[i, column] += value
    for other in (s - 1, s + 1):
        at = s - 1 if other < s else s  # the hole between the two segments
        if begin < other < end and paths.bend[at] > 0.0:
            F = paths.direction[other]
            cosine = change[0] * F[0] + change[1] * F[1] + change[2] * F[2]
            storage.bend[at, column] -= cosine / np.sin(paths.bend[at])


@inner
def _velocity(screw: Array, i: int, place: Array, k: int, out: Array) -> None:
    """Velocity (3,) of hole k at a unit rate of degree of freedom i."""
    x, y, z = place[k, 0], place[k, 1], place[k, 2]
    out[0] = screw[i, 3] + screw[i, 1] * z - screw[i, 2] * y
    out[1] = screw[i, 4] + screw[i, 2] * x - screw[i, 0] * z
    out[2] = screw[i, 5] + screw[i, 0] * y - screw[i, 1] * x


@inner
def _solve(state: State, h: float, work: Work, tangent: Tangent, storage: TangentWork) -> bool:
    """Solve for the derivative of the change of the rates, and advance the tangent."""
    n, n_free = tangent.q.shape
    A, right, reduced, U, slipping = work.matrix, storage.right, storage.reduced, storage.matrix, work.slipping
    n_slipping = 0
    for i in range(n):
        if state.mode[i] != 0:
            slipping[n_slipping] = i
            n_slipping += 1
    for x in range(n_slipping):
        i = slipping[x]
        for column in range(n_free):
            reduced[x, column] = right[i, column]
        for k in range(n):
            if state.mode[k] == 0:
                for column in range(n_free):
                    reduced[x, column] += A[min(i, k), max(i, k)] * tangent.v[k, column]
        for y in range(x, n_slipping):
            U[x, y] = A[i, slipping[y]]
    if not factor(U, n_slipping):
        return False
    for x in range(n_slipping):
        for y in range(x):
            f = U[y, x] / U[y, y]
            for column in range(n_free):
                reduced[x, column] -= f * reduced[y, column]
    for x in range(n_slipping - 1, -1, -1):
        for y in range(x + 1, n_slipping):
            for column in range(n_free):
                reduced[x, column] -= U[x, y] * reduced[y, column]
        for column in range(n_free):
            reduced[x, column] /= U[x, x]
    x = 0
    for i in range(n):
        slips = state.mode[i] != 0
        goes_on = work.goes_on[i] != 0
        for column in range(n_free):
            change = reduced[x, column] if slips else -tangent.v[i, column]
            tangent.q[i, column] += h * (tangent.v[i, column] + 0.5 * change)
            tangent.v[i, column] = tangent.v[i, column] + change if slips else 0.0
            tangent.acceleration[i, column] = change / h if goes_on else 0.0
        if slips:
            x += 1
    return True


@entry_point
def simulate_tangent(
    chain: Chain, joints: Joints, cables: Cables, holds: Booleans, free: Free, state: State, tangent: Tangent,
    durations: Array, steps: Integers, before: Array, after: Array, drive_before: Array, drive_after: Array,
    q_out: Array, v_out: Array, q_tangent: Array, v_tangent: Array,
) -> tuple[int, int]:  # fmt: skip
    """As `simulate`, with the derivatives of its results: ``q_tangent`` and ``v_tangent`` (n_intervals, n, n_free)."""
    n, n_cables, n_free = state.q.size, cables.first.size - 1, tangent.q.shape[1]
    work, storage = new_work(n, cables), new_tangent_work(n, cables, n_free)
    command, drive = np.empty(n_cables), np.empty(n)
    begin = State(state.q.copy(), state.v.copy(), state.acceleration.copy(), state.mode.copy())
    for row in range(durations.size):
        h = durations[row] / steps[row]
        for number in range(steps[row]):
            part = (number + 0.5) / steps[row]
            for c in range(n_cables):
                command[c] = before[row, c] + part * (after[row, c] - before[row, c])
            for i in range(n):
                drive[i] = drive_before[row, i] + part * (drive_after[row, i] - drive_before[row, i])
                begin.q[i], begin.v[i], begin.acceleration[i] = state.q[i], state.v[i], state.acceleration[i]
            status = step(chain, joints, cables, holds, state, command, drive, h, work)
            if status != COMPLETE:
                return status, row
            if not step_tangent(chain, joints, cables, holds, free, begin, state, h, work, tangent, storage):
                return NOT_FINITE, row
        q_out[row], v_out[row] = state.q, state.v
        q_tangent[row], v_tangent[row] = tangent.q, tangent.v
    return COMPLETE, durations.size

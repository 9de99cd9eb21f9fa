"""A serial chain of rigid bodies with revolute degrees of freedom: placement, inverse dynamics, mass matrix.

Degree of freedom i turns body i about an axis that is fixed in body i - 1 (body -1 is the base). A universal joint is
two of them without a distance or a mass in between, torsion is a third. Gravity is an upward acceleration of the base.
The equations are the recursive Newton-Euler algorithm and the composite rigid body algorithm (Featherstone 2008) about
the world's origin; their derivatives with respect to angles and rates are in closed form, of order n^2 (Singh, Russell
and Wensing, IEEE Robotics and Automation Letters 7, 2022). In the plane they are M, C and G of the thesis's Eq. 12.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.spatial.compiling import inner
from continuum.dynamics.spatial.vectors import dot, inertia_times, motion_cross_force, motion_cross_motion


class Chain(NamedTuple):
    """Geometry and masses of a chain with n degrees of freedom.

    Attributes:
        axis: unit axis of each degree of freedom in the frame of the body before it, (n, 3).
        offset: origin of each body in the frame of the body before it, (n, 3) [m].
        base: rotation of the base, from its frame to the world's, (3, 3).
        mass: mass of each body, (n,) [kg]; 0 inside a universal joint.
        center: centre of mass of each body in its frame, (n, 3) [m].
        inertia: inertia about the centre of mass in the body's frame, xx, xy, xz, yy, yz, zz, (n, 6) [kg m2].
        rotor: inertia of each joint's drive, reflected to the joint, (n,) [kg m2].
        gravity: acceleration of gravity in the world's frame, (3,) [m/s2].
    """

    axis: Array
    offset: Array
    base: Array
    mass: Array
    center: Array
    inertia: Array
    rotor: Array
    gravity: Array


class Placed(NamedTuple):
    """Bodies of a chain in a configuration.

    Attributes:
        rotation: from each body's frame to the world's, (n, 3, 3).
        origin: origin of each body, (n, 3) [m].
        screw: axis of each degree of freedom as a unit motion about the world's origin, (n, 6).
        inertia: inertia of each body about the world's origin, (n, 10).
    """

    rotation: Array
    origin: Array
    screw: Array
    inertia: Array


class Moving(NamedTuple):
    """Motions and forces of the bodies, (n, 6) each: velocities, accelerations, and forces summed from the tip."""

    velocity: Array
    acceleration: Array
    force: Array


@inner
def new_placed(n: int) -> Placed:
    """Return storage for `place`."""
    return Placed(np.empty((n, 3, 3)), np.empty((n, 3)), np.empty((n, 6)), np.empty((n, 10)))


@inner
def new_moving(n: int) -> Moving:
    """Return storage for `inverse_dynamics`."""
    return Moving(np.empty((n, 6)), np.empty((n, 6)), np.empty((n, 6)))


@inner
def place(chain: Chain, q: Array, out: Placed) -> None:
    """Place the bodies at the angles ``q`` (n,) [rad]."""
    R, p, S = out.rotation, out.origin, out.screw
    # rotation and origin of the body before
    r00, r01, r02 = chain.base[0, 0], chain.base[0, 1], chain.base[0, 2]
    r10, r11, r12 = chain.base[1, 0], chain.base[1, 1], chain.base[1, 2]
    r20, r21, r22 = chain.base[2, 0], chain.base[2, 1], chain.base[2, 2]
    px, py, pz = 0.0, 0.0, 0.0
    for i in range(q.size):
        x, y, z = chain.offset[i, 0], chain.offset[i, 1], chain.offset[i, 2]
        px += r00 * x + r01 * y + r02 * z
        py += r10 * x + r11 * y + r12 * z
        pz += r20 * x + r21 * y + r22 * z
        x, y, z = chain.axis[i, 0], chain.axis[i, 1], chain.axis[i, 2]
        sx, sy, sz = r00 * x + r01 * y + r02 * z, r10 * x + r11 * y + r12 * z, r20 * x + r21 * y + r22 * z
        p[i, 0], p[i, 1], p[i, 2] = px, py, pz
        S[i, 0], S[i, 1], S[i, 2] = sx, sy, sz
        S[i, 3], S[i, 4], S[i, 5] = py * sz - pz * sy, pz * sx - px * sz, px * sy - py * sx
        # Rodrigues about the axis in the world: columns turn together
        c, s = np.cos(q[i]), np.sin(q[i])
        t = 1.0 - c
        u00, u01, u02 = c + sx * sx * t, sx * sy * t - sz * s, sx * sz * t + sy * s
        u10, u11, u12 = sy * sx * t + sz * s, c + sy * sy * t, sy * sz * t - sx * s
        u20, u21, u22 = sz * sx * t - sy * s, sz * sy * t + sx * s, c + sz * sz * t
        r00, r10, r20 = (
            u00 * r00 + u01 * r10 + u02 * r20,
            u10 * r00 + u11 * r10 + u12 * r20,
            u20 * r00 + u21 * r10 + u22 * r20,
        )
        r01, r11, r21 = (
            u00 * r01 + u01 * r11 + u02 * r21,
            u10 * r01 + u11 * r11 + u12 * r21,
            u20 * r01 + u21 * r11 + u22 * r21,
        )
        r02, r12, r22 = (
            u00 * r02 + u01 * r12 + u02 * r22,
            u10 * r02 + u11 * r12 + u12 * r22,
            u20 * r02 + u21 * r12 + u22 * r22,
        )
        R[i, 0, 0], R[i, 0, 1], R[i, 0, 2] = r00, r01, r02
        R[i, 1, 0], R[i, 1, 1], R[i, 1, 2] = r10, r11, r12
        R[i, 2, 0], R[i, 2, 1], R[i, 2, 2] = r20, r21, r22
        if chain.mass[i] == 0.0:
            for k in range(10):
                out.inertia[i, k] = 0.0
        else:
            _inertia_about_origin(chain, i, out)


@inner
def _inertia_about_origin(chain: Chain, i: int, out: Placed) -> None:
    """Ten numbers of a body's inertia about the world's origin (parallel axes)."""
    m, R, ten = chain.mass[i], out.rotation, out.inertia
    x, y, z = chain.center[i, 0], chain.center[i, 1], chain.center[i, 2]
    cx = out.origin[i, 0] + R[i, 0, 0] * x + R[i, 0, 1] * y + R[i, 0, 2] * z
    cy = out.origin[i, 1] + R[i, 1, 0] * x + R[i, 1, 1] * y + R[i, 1, 2] * z
    cz = out.origin[i, 2] + R[i, 2, 0] * x + R[i, 2, 1] * y + R[i, 2, 2] * z
    xx, xy, xz = chain.inertia[i, 0], chain.inertia[i, 1], chain.inertia[i, 2]
    yy, yz, zz = chain.inertia[i, 3], chain.inertia[i, 4], chain.inertia[i, 5]
    ten[i, 0], ten[i, 1], ten[i, 2], ten[i, 3] = m, m * cx, m * cy, m * cz
    k = 4
    for a in range(3):
        along_x = R[i, a, 0] * xx + R[i, a, 1] * xy + R[i, a, 2] * xz
        along_y = R[i, a, 0] * xy + R[i, a, 1] * yy + R[i, a, 2] * yz
        along_z = R[i, a, 0] * xz + R[i, a, 1] * yz + R[i, a, 2] * zz
        for b in range(a, 3):
            ten[i, k] = along_x * R[i, b, 0] + along_y * R[i, b, 1] + along_z * R[i, b, 2]
            k += 1
    ten[i, 4] += m * (cy * cy + cz * cz)
    ten[i, 5] -= m * cx * cy
    ten[i, 6] -= m * cx * cz
    ten[i, 7] += m * (cx * cx + cz * cz)
    ten[i, 8] -= m * cy * cz
    ten[i, 9] += m * (cx * cx + cy * cy)


@inner
def inverse_dynamics(chain: Chain, placed: Placed, v: Array, a: Array, moving: Moving, torque: Array) -> None:
    """torque = M a + C v + G without rotors, (n,) [N m], at rates ``v`` and accelerations ``a`` [rad/s, rad/s2]."""
    n = v.size
    momentum, carried = np.empty(6), np.empty(6)
    velocity, acceleration, force = moving.velocity, moving.acceleration, moving.force
    for i in range(n):
        S = placed.screw[i]
        for k in range(6):
            before = velocity[i - 1, k] if i else 0.0
            velocity[i, k] = before + S[k] * v[i]
        motion_cross_motion(velocity[i], S, carried)
        for k in range(6):
            before = acceleration[i - 1, k] if i else (0.0 if k < 3 else -chain.gravity[k - 3])
            acceleration[i, k] = before + S[k] * a[i] + carried[k] * v[i]
        if chain.mass[i] == 0.0:
            force[i] = 0.0
            continue
        inertia_times(placed.inertia[i], acceleration[i], force[i])
        inertia_times(placed.inertia[i], velocity[i], momentum)
        motion_cross_force(velocity[i], momentum, carried)
        for k in range(6):
            force[i, k] += carried[k]
    for i in range(n - 1, -1, -1):
        if i < n - 1:
            for k in range(6):
                force[i, k] += force[i + 1, k]
        torque[i] = dot(placed.screw[i], force[i])


@inner
def mass_matrix(placed: Placed, M: Array) -> None:
    """Upper triangle of M(q) without rotors, (n, n) [kg m2]."""
    n = M.shape[0]
    composite, momentum = np.zeros(10), np.empty(6)
    for j in range(n - 1, -1, -1):
        for k in range(10):
            composite[k] += placed.inertia[j, k]
        inertia_times(composite, placed.screw[j], momentum)
        for i in range(j + 1):
            M[i, j] = dot(placed.screw[i], momentum)


class Derivatives(NamedTuple):
    """Derivatives of the torque of `inverse_dynamics`, and what further ones are made of.

    Attributes:
        by_q: by the angles, (n, n) [N m/rad].
        by_v: by the rates, (n, n) [N m s/rad].
        IS: composite inertia beyond each body times its axis, (n, 6).
        BS: axis times twice the composite Coriolis matrix B, (n, 6).
        composite: inertia of each body and all beyond it, (n, 10).
        coriolis: 2 B of each body and all beyond it, (n, 6, 6).
        work: storage, (5, n, 6).
    """

    by_q: Array
    by_v: Array
    IS: Array
    BS: Array
    composite: Array
    coriolis: Array
    work: Array


@inner
def new_derivatives(n: int) -> Derivatives:
    """Return storage for `derivatives`."""
    return Derivatives(
        np.zeros((n, n)), np.zeros((n, n)), np.zeros((n, 6)), np.zeros((n, 6)), np.zeros((n, 10)), np.zeros((n, 6, 6)),
        np.zeros((5, n, 6)),
    )  # fmt: skip


@inner
def derivatives(chain: Chain, placed: Placed, moving: Moving, out: Derivatives) -> None:
    """Derivatives at the angles, rates and accelerations for which `inverse_dynamics` has filled ``moving``."""
    screw, velocity, acceleration, force = placed.screw, moving.velocity, moving.acceleration, moving.force
    n = screw.shape[0]
    carried, first, second, at_q, at_v = out.work[0], out.work[1], out.work[2], out.work[3], out.work[4]
    still, upward, scratch = np.zeros(6), np.zeros(6), np.empty(6)
    for k in range(3):
        upward[3 + k] = -chain.gravity[k]
    for i in range(n):  # S' = v x S; psi' = v_parent x S; psi'' = a_parent x S + v_parent x psi'
        motion_cross_motion(velocity[i], screw[i], carried[i])
        shift_rates(
            velocity[i - 1] if i else still,
            acceleration[i - 1] if i else upward,
            screw[i],
            first[i],
            second[i],
            scratch,
        )
    x, y = np.empty(6), np.empty(6)
    for i in range(n - 1, -1, -1):
        for k in range(10):
            beyond = out.composite[i + 1, k] if i < n - 1 else 0.0
            out.composite[i, k] = placed.inertia[i, k] + beyond
        for r in range(6):
            for k in range(6):
                out.coriolis[i, r, k] = out.coriolis[i + 1, r, k] if i < n - 1 else 0.0
        if chain.mass[i] != 0.0:
            _add_coriolis(placed.inertia[i], velocity[i], out.coriolis[i])
        inertia_times(out.composite[i], screw[i], out.IS[i])
        inward_force(out.composite[i], out.coriolis[i], screw[i], first[i], second[i], force[i], at_q[i], scratch)
        for k in range(6):
            x[k] = first[i, k] + carried[i, k]
        inertia_times(out.composite[i], x, y)
        for r in range(6):
            along, turned = 0.0, 0.0
            for k in range(6):
                along += screw[i, k] * out.coriolis[i, k, r]
                turned += out.coriolis[i, r, k] * screw[i, k]
            out.BS[i, r] = along
            at_v[i, r] = y[r] + turned
    for i in range(n):
        for j in range(i + 1):
            by_q, by_v = 0.0, 0.0
            for k in range(6):
                by_q += out.BS[i, k] * first[j, k] + out.IS[i, k] * second[j, k]
                by_v += out.BS[i, k] * screw[j, k] + out.IS[i, k] * (first[j, k] + carried[j, k])
            out.by_q[i, j], out.by_v[i, j] = by_q, by_v
            if j < i:
                out.by_q[j, i] = dot(screw[j], at_q[i])
                out.by_v[j, i] = dot(screw[j], at_v[i])


@inner
def shift_rates(
    velocity: Array, acceleration: Array, screw: Array, first: Array, second: Array, scratch: Array
) -> None:
    """Rates of change of velocity and acceleration (6,) by a displacement along a screw that moves with a body.

    first = v x s, second = a x s + v x first, for the velocity and acceleration of that body.
    """
    motion_cross_motion(velocity, screw, first)
    motion_cross_motion(acceleration, screw, second)
    motion_cross_motion(velocity, first, scratch)
    for k in range(6):
        second[k] += scratch[k]


@inner
def inward_force(
    composite: Array, coriolis: Array, screw: Array, first: Array, second: Array, force: Array, out: Array,
    scratch: Array,
) -> None:  # fmt: skip
    """out = I_C psi'' + 2 B_C psi' + s x* f, the change of the force (6,) on what lies beyond a displacement."""
    inertia_times(composite, second, out)
    motion_cross_force(screw, force, scratch)
    for r in range(6):
        along = 0.0
        for k in range(6):
            along += coriolis[r, k] * first[k]
        out[r] += along + scratch[r]


@inner
def _add_coriolis(inertia: Array, v: Array, out: Array) -> None:
    """out += 2 B, (6, 6), with 2 B m = v x* (I m) - I (v x m) + m x* (I v) for every motion m."""
    momentum, unit, x, y, z = np.empty(6), np.zeros(6), np.empty(6), np.empty(6), np.empty(6)
    inertia_times(inertia, v, momentum)
    for k in range(6):
        unit[:] = 0.0
        unit[k] = 1.0
        inertia_times(inertia, unit, x)
        motion_cross_force(v, x, y)
        motion_cross_motion(v, unit, x)
        inertia_times(inertia, x, z)
        motion_cross_force(unit, momentum, x)
        for r in range(6):
            out[r, k] += y[r] - z[r] + x[r]

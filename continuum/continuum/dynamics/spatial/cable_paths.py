"""Cables as polylines through holes: lengths and their gradients, slip at every hole, tensions by the capstan law.

Segment k of a cable runs from hole k - 1 to hole k. The bodies between these two holes alone change its length, so that
each degree of freedom changes the length of one segment of a cable at most. A cable may start anywhere, pass through
any number of sections and end at any body; with a first hole behind the base plate it also bends at the plate.

The tension falls from a segment to the next one by exp(-mu phi s) (Eq. 14): phi is the angle by which the cable bends
at the hole, and s = tanh(k_l w) the smoothed sign of the speed w at which it slips towards the base (Eq. 15). The
torque of a cable is the virtual work of its tensions, -sum_k T_k dL_k/dq.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from continuum.arrays import Array, Booleans, Integers
from continuum.dynamics.spatial.chain import Placed
from continuum.dynamics.spatial.compiling import inner

SATURATED = 9.0
"""Argument beyond which tanh is 1 within 3e-8."""


class Cables(NamedTuple):
    """Cables of an arm; cable c runs through the holes first[c] .. first[c + 1] - 1, outwards.

    Attributes:
        first: index of each cable's first hole, and the number of holes, (n_cables + 1,).
        body: body of each hole, -1 for the base, never decreasing along a cable, (n_holes,).
        hole: position of each hole in the frame of its body, (n_holes, 3) [m].
        friction: mu of each cable at its holes, (n_cables,).
        slope: k_l of each cable [s/m], (n_cables,).
        stiffness: of each cable between its motor and its first hole, where a length is held, (n_cables,) [N/m].
        damping: of the same, (n_cables,) [N s/m].
    """

    first: Integers
    body: Integers
    hole: Array
    friction: Array
    slope: Array
    stiffness: Array
    damping: Array


class Paths(NamedTuple):
    """Paths of the cables in a configuration; entries of first holes are unused.

    Attributes:
        place: holes in the world, (n_holes, 3) [m].
        direction: unit vector of the segment that ends at each hole, outwards, (n_holes, 3).
        length: of that segment, (n_holes,) [m].
        gradient: derivative of the length of the one segment that each angle changes, (n_cables, n) [m/rad]: of segment
            k for the bodies body[k - 1] + 1 .. body[k].
        bend: angle between that segment and the next one, 0 at the last hole, (n_holes,) [rad].
    """

    place: Array
    direction: Array
    length: Array
    gradient: Array
    bend: Array


class Pull(NamedTuple):
    """State of the cables' friction in a step; entries of first holes are unused.

    Attributes:
        slip: speed w towards the base about which the friction of each hole is linearised, (n_holes,) [m/s].
        turns: whether the slip turns within the step, so that ``slip`` is 0, (n_holes,).
        tension: of the segment that ends at each hole, at those speeds, (n_holes,) [N].
        damping: derivative of the friction at each hole by its slip, (n_holes,) [N s/m].
        base: of each cable between its motor and its first hole, (n_cables,) [N].
        base_damping: derivative of ``base`` by the rate of the path's length at the end, (n_cables,) [N s/m].
    """

    slip: Array
    turns: Booleans
    tension: Array
    damping: Array
    base: Array
    base_damping: Array


@inner
def new_paths(cables: Cables, n: int) -> Paths:
    """Return storage for `trace` in a chain of ``n`` degrees of freedom."""
    holes, c = cables.body.size, cables.first.size - 1
    return Paths(np.empty((holes, 3)), np.empty((holes, 3)), np.zeros(holes), np.zeros((c, n)), np.zeros(holes))


@inner
def new_pull(cables: Cables) -> Pull:
    """Return storage for the tensions."""
    n, c = cables.body.size, cables.first.size - 1
    return Pull(np.zeros(n), np.zeros(n, np.bool_), np.zeros(n), np.zeros(n), np.zeros(c), np.zeros(c))


@inner
def trace(cables: Cables, base: Array, placed: Placed, out: Paths) -> None:
    """Trace the cables through the placed bodies; ``base`` (3, 3) turns the base's frame to the world's."""
    R, p, S, place, direction = placed.rotation, placed.origin, placed.screw, out.place, out.direction
    for c in range(cables.first.size - 1):
        begin, end = cables.first[c], cables.first[c + 1]
        X, Y, Z, ex, ey, ez = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for k in range(begin, end):
            b = cables.body[k]
            before_x, before_y, before_z, dx, dy, dz = X, Y, Z, ex, ey, ez
            x, y, z = cables.hole[k, 0], cables.hole[k, 1], cables.hole[k, 2]
            if b < 0:
                X = base[0, 0] * x + base[0, 1] * y + base[0, 2] * z
                Y = base[1, 0] * x + base[1, 1] * y + base[1, 2] * z
                Z = base[2, 0] * x + base[2, 1] * y + base[2, 2] * z
            else:
                X = p[b, 0] + R[b, 0, 0] * x + R[b, 0, 1] * y + R[b, 0, 2] * z
                Y = p[b, 1] + R[b, 1, 0] * x + R[b, 1, 1] * y + R[b, 1, 2] * z
                Z = p[b, 2] + R[b, 2, 0] * x + R[b, 2, 1] * y + R[b, 2, 2] * z
            place[k, 0], place[k, 1], place[k, 2] = X, Y, Z
            if k == begin:
                continue
            ex, ey, ez = X - before_x, Y - before_y, Z - before_z
            length = np.sqrt(ex * ex + ey * ey + ez * ez)
            inverse = 1.0 / length
            ex, ey, ez = ex * inverse, ey * inverse, ez * inverse
            out.length[k] = length
            direction[k, 0], direction[k, 1], direction[k, 2] = ex, ey, ez
            # moment of the direction at the outer hole about the origin: (X x E, E) . screw
            mx, my, mz = Y * ez - Z * ey, Z * ex - X * ez, X * ey - Y * ex
            for i in range(cables.body[k - 1] + 1, b + 1):
                turning = mx * S[i, 0] + my * S[i, 1] + mz * S[i, 2]
                out.gradient[c, i] = turning + ex * S[i, 3] + ey * S[i, 4] + ez * S[i, 5]
            if k > begin + 1 and cables.friction[c] > 0.0:
                x, y, z = ex - dx, ey - dy, ez - dz
                half = 0.5 * np.sqrt(x * x + y * y + z * z)
                out.bend[k - 1] = 2.0 * np.arcsin(min(half, 1.0))
        out.bend[end - 1] = 0.0

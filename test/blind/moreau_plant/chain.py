"""Mechanics of a planar chain of hinged bodies, in absolute angles Phi and in those of its hinges q.

Body k hangs on the one before by hinge k; Phi_k = q_0 + ... + q_k is its angle from plumb. With d(Phi) = (sin Phi,
-cos Phi), its hinge is where the bodies before end, its centre of mass c_k d(Phi_k) beyond, its end l_k d(Phi_k).
With the first moments S_k = m_k c_k + l_k (mass of all bodies beyond), Lagrange's equations in absolute angles are

    sum_k G_jk (cos(Phi_j - Phi_k) Phi_k'' + sin(Phi_j - Phi_k) Phi_k'^2) = S_j (g_x cos Phi_j + g_z sin Phi_j) + ...

with G_jk = l_j S_k for j < k and G_kk = I_k + m_k c_k^2 + l_k^2 (mass beyond). A link is a body, and so are a base
plate that can turn and the ball of a joint with play.
"""

from typing import NamedTuple

import numpy as np

from blind.moreau_plant.compiled import compiled
from blind.moreau_plant.mechanism import Mechanism
from blind.mujoco_plant.parameters import GRAVITY, JOINTS

PLATE_MASS = 0.4  # of a base plate that can turn [kg]
PLATE_INERTIA = 5e-4  # [kg m^2]
BASE_DAMPING_RATIO = 0.05
CARRIED = 0.013  # inertia of the hanging arm about the base [kg m^2], for the damping only
BALL_INERTIA = 2e-6  # of the ball of a joint with play; its mass is counted with its link [kg m^2]


class Chain(NamedTuple):
    """Bodies and hinges, n of each.

    Attributes:
        length: from each body's hinge to the next (n,) [m].
        centre: of mass, from the hinge (n,) [m].
        mass: (n,) [kg]; without the loads on the tip.
        inertia: about the centre of mass (n,) [kg m^2].
        stiffness: of the hinges' springs (n,) [N m/rad].
        rest: where they are at rest (n,) [rad].
        viscous: damping (n,) [N m s/rad].
        stop: how far a hinge turns to either side before it strikes a stop (n,), infinite where there is none [rad].
        hinge: number of the hinge with each joint's spring and friction (5,).
        link: number of each link's body (5,); the joint's angle is that of all hinges from ``hinge`` to here.
    """

    length: np.ndarray
    centre: np.ndarray
    mass: np.ndarray
    inertia: np.ndarray
    stiffness: np.ndarray
    rest: np.ndarray
    viscous: np.ndarray
    stop: np.ndarray
    hinge: np.ndarray
    link: np.ndarray


def assemble(m: Mechanism) -> Chain:
    """The chain of an arm: five links, a plate before them if the base gives way, a ball before each link with play."""
    b = m.half_spacing
    bodies: list[tuple[float, ...]] = []
    hinge, link = [], []
    if m.base_compliance:
        stiffness = 1 / m.base_compliance
        damping = 2 * BASE_DAMPING_RATIO * float(np.sqrt(stiffness * (CARRIED + PLATE_INERTIA)))
        bodies.append((b, 0.0, PLATE_MASS, PLATE_INERTIA, stiffness, 0.0, damping, np.inf))
    for i in range(JOINTS):
        spring = m.stiffness[i], m.rest_angle[i], m.viscous[i], np.inf
        hinge.append(len(bodies))
        if m.clearance[i]:
            bodies.append((0.0, 0.0, 0.0, BALL_INERTIA, *spring))
            spring = 0.0, 0.0, 0.0, m.clearance[i]
        link.append(len(bodies))
        bodies.append((2 * b, b, m.mass[i], m.inertia[i], *spring))
    columns = (np.array(column, dtype=float) for column in zip(*bodies, strict=True))
    return Chain(*columns, np.array(hinge), np.array(link))


@compiled
def equations(
    chain: Chain, load: float, turned: np.ndarray, rate: np.ndarray, pull: np.ndarray, mass: np.ndarray, out: np.ndarray
) -> None:
    """Mass matrix and torques of gravity and of centrifugal forces, by the hinges' angles.

    Args:
        chain: the bodies.
        load: point mass at the last one's centre [kg].
        turned: absolute angles (n,) [rad].
        rate: absolute rates (n,) [rad/s].
        pull: acceleration of gravity (2,), across and up [m/s^2].
        mass: becomes the matrix (n, n) [kg m^2].
        out: becomes the torques (n,) [N m].
    """
    n = turned.size
    cos, sin = np.cos(turned), np.sin(turned)
    first = np.empty(n)
    beyond = 0.0
    for k in range(n - 1, -1, -1):
        own = chain.mass[k] + (load if k == n - 1 else 0.0)
        first[k] = own * chain.centre[k] + chain.length[k] * beyond
        mass[k, k] = chain.inertia[k] + own * chain.centre[k] ** 2 + chain.length[k] ** 2 * beyond
        out[k] = first[k] * (pull[0] * cos[k] + pull[1] * sin[k])
        beyond += own
    for k in range(n):
        for j in range(k):
            g = chain.length[j] * first[k]
            across = g * (sin[j] * cos[k] - cos[j] * sin[k])
            mass[j, k] = mass[k, j] = g * (cos[j] * cos[k] + sin[j] * sin[k])
            out[j] -= across * rate[k] ** 2
            out[k] += across * rate[j] ** 2
    to_hinges(out)
    for k in range(n):
        to_hinges(mass[k])
    for k in range(n - 2, -1, -1):
        mass[k] += mass[k + 1]


@compiled
def to_hinges(absolute: np.ndarray) -> None:
    """Generalised forces by absolute angles (n,) become those by the hinges' angles: sums from each hinge on."""
    for k in range(absolute.size - 2, -1, -1):
        absolute[k] += absolute[k + 1]


@compiled
def gravity(m: Mechanism, time: float) -> np.ndarray:
    """Its acceleration in the plate's frame (2,), across and up, less that of a shaken bracket [m/s^2]."""
    shaken = m.shake * np.sin(m.shake_rate * time + m.shake_phase)
    return np.array([-GRAVITY * np.sin(m.base_tilt) - shaken, -GRAVITY * np.cos(m.base_tilt)])

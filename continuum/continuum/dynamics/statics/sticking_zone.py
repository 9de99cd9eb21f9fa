"""All postures in which an arm stays though they are no equilibrium: its joints' dry friction holds what is left.

The zone is the set of postures in which every joint is pulled by no more than its break-away torque, |tau_i| <=
tau_c,i (1 + S_i), connected with the equilibrium. It has as many dimensions as there are joints; told is, for each
joint, the smallest and the largest angle over the whole zone, the other joints anywhere in it: its projection, which
is wider than what the joint may do with the others at equilibrium. At such an extreme every joint is on the verge of
slipping: the torque is at a corner of the box, the one whose signs are those of d theta_i / d tau_j.

The cables' friction is no part of the zone: their tensions are those of the load's approach, as if they slid. Cables
that slid the other way have a zone of their own, that of the load with the other approach; between the two, what the
discs hold lets the arm stay too.

Eq. 13's friction is smooth, so within the zone the joints do creep, at speeds around 1 / k_v or below.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.planar.springs_and_friction import break_away_torque
from continuum.dynamics.statics.equilibrium import Equilibrium, joint_stiffness, solve_pull
from continuum.dynamics.statics.resting_arm import RestingArm

_MOST_CORNERS = 10


@dataclass(frozen=True)
class StickingZone:
    """The zone of one equilibrium; NaN where an end was not found.

    Attributes:
        break_away: largest torque that each resting joint holds, (n,) [N m].
        lower, upper: smallest and largest angle of each joint over the zone, (n,) [rad].
        postures: in which these are reached: lower ends, then upper ones, (2, n joints whose end it is, n) [rad].
        total_bend: smallest and largest sum of the joint angles over the zone, (2,) [rad].
    """

    break_away: Array
    lower: Array
    upper: Array
    postures: Array
    total_bend: Array


def sticking_zone(arm: RestingArm, around: Equilibrium) -> StickingZone:
    """The zone around a stable equilibrium.

    Friction that effects add as torques of their own is not counted, parameters of Eq. 13 that they change are.
    """
    n, held = arm.model.n_joints, break_away(arm.model)
    ends = np.array([[_extreme(arm, around, side * unit, held) for unit in np.eye(n)] for side in (-1.0, 1.0)])
    angles = np.einsum("sii->si", ends)
    total = [_extreme(arm, around, np.full(n, side), held).sum() for side in (-1.0, 1.0)]
    return StickingZone(held, angles[0], angles[1], ends, np.array(total))


def break_away(model: Model) -> Array:
    """Largest torque that each resting joint holds, tau_c (1 + S), (n,) [N m]."""
    return np.asarray(break_away_torque(model.changed_parameters), dtype=float)


def _extreme(arm: RestingArm, around: Equilibrium, weights: Array, held: Array) -> Array:
    """Posture of the zone in which weights . theta is largest, (n,) [rad].

    Steps from corner to corner by the derivatives there. Where a derivative near zero changes its sign between two
    corners, the better corner is taken.
    """
    n, y = held.size, around.unknowns
    visited: dict[bytes, Array] = {}
    for _ in range(_MOST_CORNERS):
        stiffness = joint_stiffness(arm.pull(y, around.load)[1], n)
        corner = held * np.sign(np.linalg.solve(stiffness.T, weights))
        if corner.tobytes() in visited:
            break
        found = solve_pull(arm, around.load, y, corner)
        if found is None:
            return np.full(n, np.nan)
        visited[corner.tobytes()] = y = found
    return max((posture[:n] for posture in visited.values()), key=lambda theta: float(weights @ theta))

"""Sticking zone: all postures around an equilibrium in which the joints' dry friction holds the arm at rest.

The zone is the set of postures, connected with the equilibrium, in which the net torque at every joint is at most its
break-away torque, |tau_i| <= tau_c,i (1 + S_i). It has as many dimensions as there are joints. The result gives the
smallest and the largest angle of each joint over the whole zone, that is, the zone's projection; it is wider than the
interval of that joint with the other joints at equilibrium. At such an extreme every joint is about to slip: the torque
is at the corner of the box whose signs are those of d theta_i / d tau_j.

The cables' friction is not part of the zone: the cable tensions are those of sliding in the direction of the load's
approach. Cables that slid in the opposite direction have another zone, that of the load with the opposite approach;
between the two zones, friction at the discs can hold the arm too.

The friction of Eq. 13 is smooth, so within the zone the joints creep, at speeds of about 1 / k_v or less.
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
    """The zone of one equilibrium; NaN for an end that was not found.

    Attributes:
        break_away: largest torque that the friction of each resting joint holds, (n,) [N m].
        lower, upper: smallest and largest angle of each joint over the zone, (n,) [rad].
        postures: postures at these extremes: lower ends, then upper ones, (2, n joints at their end, n) [rad].
        total_bend: smallest and largest sum of the joint angles over the zone, (2,) [rad].
    """

    break_away: Array
    lower: Array
    upper: Array
    postures: Array
    total_bend: Array


def sticking_zone(arm: RestingArm, around: Equilibrium) -> StickingZone:
    """Return the zone around a stable equilibrium.

    The zone includes changes of the parameters of Eq. 13 by effects, but not friction torques that effects add.
    """
    n, held = arm.model.n_joints, break_away(arm.model)
    ends = np.array([[_extreme(arm, around, side * unit, held) for unit in np.eye(n)] for side in (-1.0, 1.0)])
    angles = np.einsum("sii->si", ends)
    total = [_extreme(arm, around, np.full(n, side), held).sum() for side in (-1.0, 1.0)]
    return StickingZone(held, angles[0], angles[1], ends, np.array(total))


def break_away(model: Model) -> Array:
    """Largest torque that the friction of each resting joint holds, tau_c (1 + S), (n,) [N m]."""
    return np.asarray(break_away_torque(model.changed_parameters), dtype=float)


def _extreme(arm: RestingArm, around: Equilibrium, weights: Array, held: Array) -> Array:
    """Return the posture of the zone with the largest weights . theta, (n,) [rad].

    The search moves from corner to corner according to the derivatives there. If a derivative near zero changes its
    sign between two corners, it returns the better corner.
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

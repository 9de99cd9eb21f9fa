"""The posture in which the dynamic model holds a given total bend.

The total bend is held in the first possible of these ways.

1. By known tensions, or no tension if none is known, and the joints' dry friction: all joints need the same fraction of
   their break-away torque, 1 or -1 as in an arm that is pulled slowly, or less. At 0 it is an equilibrium.
2. If friction cannot hold it: by known tensions times a factor, at an equilibrium.
3. If they cannot either, or none are known: by one cable, on the side of the bend, at an equilibrium.

Cables lose tension over the discs as they did when they last slid (Eq. 15).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from continuum.arrays import Array
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.dynamics.statics.equilibrium import (
    Equilibrium,
    EquilibriumStatus,
    equilibrium,
    joint_stiffness,
    solve_pull,
)
from continuum.dynamics.statics.resting_arm import Load, RestingArm
from continuum.dynamics.statics.sticking_zone import StickingZone, break_away, sticking_zone
from continuum.errors import InvalidValueError

_MOST = 1e4  # [N], or times the known tensions


@dataclass(frozen=True)
class HeldPosture:
    """A posture that the model holds.

    Attributes:
        theta: joint angles, (n,) [rad].
        derivative: their change with the total bend, (n,).
        load: tensions at the base, and the direction in which the cables slid last.
        friction: fraction of its break-away torque that every joint needs, from -1 to 1; 0 at an equilibrium.
        zone: postures that dry friction holds under that load.
        known: range of total bends that dry friction holds under the known tensions, (2,) [rad], if this is not one.
    """

    theta: Array
    derivative: Array
    load: Load
    friction: float
    zone: StickingZone
    known: Array | None = None


def held_posture(arm: RestingArm, total_bend: float, tension: Array | None, approach: int) -> HeldPosture:
    """Return the posture whose joint angles add up to ``total_bend``.

    Args:
        arm: arm of the model.
        total_bend: sum of the joint angles [rad].
        tension: tension of each cable at the base, (2,) [N]; None if unknown.
        approach: direction in which the joints bent last: 1 towards positive angles, -1 towards negative ones.

    Raises:
        InvalidValueError: no tension of one cable holds this bend.
    """
    load, known = Load(np.zeros(SIDES.size) if tension is None else tension, approach), None
    if (rests := _stable(arm, load, np.full(arm.model.n_joints, total_bend / arm.model.n_joints))) is not None:
        zone = sticking_zone(arm, rests)
        if (held := _by_friction(arm, rests, total_bend)) is not None:
            y, friction = held
            return HeldPosture(y[: arm.model.n_joints], _derivative(arm, y, load), load, friction, zone)
        known = None if tension is None else zone.total_bend
    pulled = None if tension is None else _by_tension(arm, load, total_bend)
    if pulled is None:
        hangs = _stable(arm, Load(np.zeros(SIDES.size)), None)
        side = np.sign(total_bend - (0.0 if hangs is None else hangs.theta.sum()))
        pulled = _by_tension(arm, Load(1.0 * (side == SIDES), approach), total_bend)
    if pulled is None:
        allowed = f"one that up to {_MOST:g} N of one cable can hold in the model"
        raise InvalidValueError("total bend [degrees]", round(float(np.degrees(total_bend)), 2), allowed)
    derivative = _derivative(arm, pulled.unknowns, pulled.load)
    return HeldPosture(pulled.theta, derivative, pulled.load, 0.0, sticking_zone(arm, pulled), known)


def _by_friction(arm: RestingArm, rests: Equilibrium, total: float) -> tuple[Array, float] | None:
    """Return angles and states (n + n_states,), and the fraction of break-away torque that holds all joints there."""
    held = break_away(arm.model)
    found: dict[float, Array] = {0.0: rests.unknowns}

    def missing(part: float) -> float:
        near = found[min(found, key=lambda other: abs(other - part))]
        y = solve_pull(arm, rests.load, near, part * held)
        if y is None:
            return np.nan
        found[part] = y
        return total - float(y[: held.size].sum())

    ends = missing(-1.0), missing(1.0)
    if not ends[0] > 0 > ends[1]:
        return None
    part = float(brentq(missing, -1.0, 1.0, xtol=1e-9))
    missing(part)
    return found[part], part


def _by_tension(arm: RestingArm, load: Load, total: float) -> Equilibrium | None:
    """Return the stable equilibrium with the total bend [rad] under tensions proportional to the load's, or None.

    Tensions rise from zero, as in `continuum.dynamics.pulled_posture`, which handles one cable and one direction.
    """
    hangs = _stable(arm, Load(np.zeros(SIDES.size), load.approach), None)
    if hangs is None or not np.any(load.tension):
        return None
    found, side = {0.0: hangs}, float(np.sign(total - hangs.theta.sum()))

    def missing(factor: float) -> float:
        """Return how much further the arm has to bend [rad]."""
        near = found[min(found, key=lambda other: abs(other - factor))]
        rests = _stable(arm, Load(factor * load.tension, load.approach), near.theta)
        if rests is None:
            return np.nan
        found[factor] = rests
        return side * (total - float(rests.theta.sum()))

    low, high = 0.0, 0.1
    while (left := missing(high)) > 0:
        low, high = high, 2 * high
        if high > _MOST:
            return None
    if np.isnan(left):
        return None
    factor = float(brentq(missing, low, high, xtol=1e-9))
    missing(factor)
    return found[factor]


def _stable(arm: RestingArm, load: Load, start: Array | None) -> Equilibrium | None:
    found = equilibrium(arm, load, start)
    return found if found.status is EquilibriumStatus.STABLE else None


def _derivative(arm: RestingArm, y: Array, load: Load) -> Array:
    """Return the change of the joint angles with the total bend as the same torque grows at all joints, (n,).

    A cable's pull nearly does that: its lever is the same at every disc except for the joint's angle and its losses.
    """
    n = arm.model.n_joints
    yielding = np.linalg.solve(joint_stiffness(arm.pull(y, load)[1], n), np.ones(n))
    return np.asarray(yielding / yielding.sum())

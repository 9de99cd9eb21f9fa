"""The posture in which the dynamic model holds a given total bend.

What makes the model's total bend the given one is tried in this order.

1. Known tensions, or no tension where none is known, and the joints' dry friction: all joints need the same part of
   their break-away torque, as while an arm is pulled slowly (1 or -1), or less. At 0 it is an equilibrium.
2. Where friction cannot hold it, known tensions times a factor, at an equilibrium.
3. Where they cannot either, or none are known, one cable, that on the side of the bend, at an equilibrium.

Cables lose tension over the discs as they did when they slid last (Eq. 15).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from continuum.arrays import Array
from continuum.dynamics.planar.cables import SIDES
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
    """What the model holds.

    Attributes:
        theta: joint angles, (n,) [rad].
        derivative: their change with the total bend, (n,).
        load: tensions at the base, and which way the cables slid last.
        friction: part of its break-away torque that every joint needs, from -1 to 1; 0 at an equilibrium.
        zone: what dry friction holds under that load.
        known: what dry friction holds in total under the known tensions, (2,) [rad], where it does not hold this bend.
    """

    theta: Array
    derivative: Array
    load: Load
    friction: float
    zone: StickingZone
    known: Array | None = None


def held_posture(arm: RestingArm, total_bend: float, tension: Array | None, approach: int) -> HeldPosture:
    """The posture whose joint angles add up to ``total_bend``.

    Args:
        arm: of the model.
        total_bend: [rad].
        tension: of each cable at the base, (2,) [N]; None where it is not known.
        approach: which way the joints bent last: 1 towards positive angles, -1 towards negative ones.

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
        allowed = f"one that up to {_MOST:g} N of one cable hold in the model"
        raise InvalidValueError("total bend [degrees]", round(float(np.degrees(total_bend)), 2), allowed)
    derivative = _derivative(arm, pulled.unknowns, pulled.load)
    return HeldPosture(pulled.theta, derivative, pulled.load, 0.0, sticking_zone(arm, pulled), known)


def _by_friction(arm: RestingArm, rests: Equilibrium, total: float) -> tuple[Array, float] | None:
    """Angles and states (n + n_states,), and the part of their break-away torque that all joints need to stay there."""
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
    """The stable equilibrium with the total bend [rad] under tensions in proportion to the load's; None: there is none.

    From no tension upwards, as `continuum.dynamics.pulled_posture`, which knows one cable and one direction.
    """
    hangs = _stable(arm, Load(np.zeros(SIDES.size), load.approach), None)
    if hangs is None or not np.any(load.tension):
        return None
    found, side = {0.0: hangs}, float(np.sign(total - hangs.theta.sum()))

    def missing(factor: float) -> float:
        """How much further the arm has to bend [rad]."""
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
    """Change of the joint angles with the total bend as the same torque grows at all joints, (n,).

    A cable's pull grows nearly so: its lever is the same at every disc but for the joint's angle and its losses.
    """
    n = arm.model.n_joints
    yielding = np.linalg.solve(joint_stiffness(arm.pull(y, load)[1], n), np.ones(n))
    return np.asarray(yielding / yielding.sum())

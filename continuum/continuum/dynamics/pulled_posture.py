"""The posture in which one cable, pulled slowly, holds an arm at a total bend: there the thesis's releases begin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.planar.cable_tension import SIDES
from continuum.dynamics.statics.equilibrium import Equilibrium, EquilibriumStatus, equilibrium
from continuum.dynamics.statics.resting_arm import Load, RestingArm
from continuum.errors import InvalidValueError

_MOST = 1e4  # [N]


@dataclass(frozen=True)
class PulledPosture:
    """An arm that is held by one cable; the joints' friction holds nothing.

    Attributes:
        theta: joint angles, (n,) [rad].
        tension: of each cable at the base, (n_cables,) [N].
    """

    theta: Array
    tension: Array


def pulled_posture(model: Model, total_bend: float) -> PulledPosture:
    """Pull the cable on the side of ``total_bend`` [rad], the sum of the joint angles, until the arm is bent so far.

    Raises:
        InvalidValueError: pulling that cable does not bend the arm so.
    """
    arm, side = RestingArm(model), 1 if total_bend > 0 else -1
    found: dict[float, Equilibrium] = {0.0: equilibrium(arm, Load(np.zeros(len(SIDES)), side))}

    def missing(tension: float) -> float:
        """How much further the arm has to bend [rad], from the equilibrium with a tension near by."""
        near = found[min(found, key=lambda other: abs(other - tension))]
        found[tension] = equilibrium(arm, Load(np.where(side == SIDES, tension, 0.0), side), near.theta)
        if found[tension].status is not EquilibriumStatus.STABLE:
            allowed = f"one to which a cable pulls; there is no stable equilibrium at {tension:g} N"
            raise InvalidValueError("total bend", total_bend, allowed)
        return float(side * (total_bend - found[tension].theta.sum()))

    low, high = 0.0, 0.1
    if missing(low) < 0:
        raise InvalidValueError("total bend", total_bend, "further to that side than the arm hangs by itself")
    while missing(high) > 0:
        low, high = high, 2 * high
        if high > _MOST:
            raise InvalidValueError("total bend", total_bend, f"one to which {_MOST:g} N pull")
    tension = float(brentq(missing, low, high, xtol=1e-9))
    missing(tension)
    return PulledPosture(found[tension].theta, found[tension].load.tension)

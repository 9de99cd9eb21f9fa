"""The posture in which one slowly pulled cable holds an arm at a total bend, the start of the thesis's releases."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.dynamics.statics.equilibrium import Equilibrium, EquilibriumStatus, equilibrium
from continuum.dynamics.statics.resting_arm import Load, RestingArm
from continuum.errors import InvalidValueError

_MOST = 1e4  # largest tension [N]


@dataclass(frozen=True)
class PulledPosture:
    """Posture of an arm that one cable holds without the joints' friction.

    Attributes:
        theta: joint angles, (n,) [rad].
        tension: tension of each cable at the base, (n_cables,) [N].
    """

    theta: Array
    tension: Array


def pulled_posture(model: Model, total_bend: float) -> PulledPosture:
    """Pull the cable on the side of ``total_bend`` [rad], the sum of the joint angles, until the arm reaches it.

    Raises:
        InvalidValueError: pulling that cable does not bend the arm to ``total_bend``.
    """
    arm, side = RestingArm(model), 1 if total_bend > 0 else -1
    found: dict[float, Equilibrium] = {0.0: equilibrium(arm, Load(np.zeros(len(SIDES)), side))}

    def missing(tension: float) -> float:
        """Return the remaining bend [rad], starting from the equilibrium at a similar tension."""
        near = found[min(found, key=lambda other: abs(other - tension))]
        found[tension] = equilibrium(arm, Load(np.where(side == SIDES, tension, 0.0), side), near.theta)
        if found[tension].status is not EquilibriumStatus.STABLE:
            allowed = f"a bend that a cable can hold; there is no stable equilibrium at {tension:g} N"
            raise InvalidValueError("total bend", total_bend, allowed)
        return float(side * (total_bend - found[tension].theta.sum()))

    low, high = 0.0, 0.1
    if missing(low) < 0:
        raise InvalidValueError("total bend", total_bend, "a bend further to that side than that of the hanging arm")
    while missing(high) > 0:
        low, high = high, 2 * high
        if high > _MOST:
            raise InvalidValueError("total bend", total_bend, f"a bend that at most {_MOST:g} N can hold")
    tension = float(brentq(missing, low, high, xtol=1e-9))
    missing(tension)
    return PulledPosture(found[tension].theta, found[tension].load.tension)

"""Base of effects whose states are the tensions that pull: one for each cable, at first what is commanded."""

from __future__ import annotations

from continuum.arrays import Array
from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.cables import SIDES

LEAST_LAG = 1e-5
"""Shortest time constant [s], of which nothing is seen: without any, the states would have no rates."""


class CableStates(Effect):
    """T of each cable [N]."""

    def n_states(self, n_joints: int) -> int:
        return len(SIDES)

    def pull(self, u: Numbers, params: EffectParams, state: Numbers) -> Numbers:
        return state

    def initial_state(self, theta: Array, u: Array, params: EffectParams, p: Parameters) -> Array:
        return u.copy()

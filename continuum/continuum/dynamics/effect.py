"""What a further physical effect is to the dynamic model: a few hooks, each of which by default changes nothing.

An effect is one small file that defines one class and is found by the entry point group ``continuum.effects``; adding
one touches no other file. Every hook is given the effect's own parameter values, ``own``, arrays by name, and where
it has states of its own, their values; it is traced with symbols like the rest of Eq. 12.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameter, Parameters
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.planar.motion import Motion

Own = Mapping[str, Numbers]


class Effect:
    """Base of all effects.

    Class attributes:
        name: as model files and verdicts print it.
        parameters: the effect's own, by name; at their defaults the effect is absent.
    """

    name: ClassVar[str]
    parameters: ClassVar[Mapping[str, Parameter]] = {}

    def n_states(self, n_joints: int) -> int:
        """Number of states that the effect adds."""
        return 0

    def change_parameters(self, p: Parameters, own: Own) -> Parameters:
        """Parameters of Eq. 12 as the effect makes them."""
        return p

    def move_base(self, motion: Motion, own: Own, state: Numbers, state_rate: Numbers) -> Motion:
        """Motion with the base plate turned."""
        return motion

    def pull(self, u: Numbers, own: Own, state: Numbers) -> Numbers:
        """Tensions of the cables at the base, (n_cables,) [N], of those commanded."""
        return u

    def torque(self, now: Instant, own: Own, state: Numbers) -> Numbers:
        """Added to the left side of Eq. 12, (n,) or (1,) [N m]: a torque that resists."""
        return np.zeros(1)

    def state_balance(self, now: Instant, own: Own, state: Numbers, state_rate: Numbers) -> Numbers:
        """Zero when the effect's states obey their equations, (n_states,)."""
        return state_rate

"""The compiled equations of an arm at rest: what pulls at the joints but for their friction, and how it changes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.compiled.equations import CompiledEquations
from continuum.dynamics.model import Model
from continuum.dynamics.planar.cable_tension import SIDES
from continuum.dynamics.simulation_input import finite_array
from continuum.dynamics.values import parameter_slots, parameter_vector
from continuum.errors import InvalidValueError

_CREEP = 1e-12  # joint speed that tells the cables' direction and is felt by nothing else [rad/s]
_ANY_SPEED = 1e18  # cable_slope with which it does [s/m]


@dataclass(frozen=True)
class Load:
    """What is done to an arm that rests.

    Attributes:
        tension: of each cable at the base, (n_cables,) [N], none negative.
        approach: which way all joints bent last: 1 towards positive angles, -1 towards negative ones. By it every cable
            loses tension over the discs as it did while it slid (Eq. 15). 0: no losses.
    """

    tension: Array
    approach: int = 0

    def __post_init__(self) -> None:
        tension = finite_array("tension", self.tension, "finite, >= 0 N, one for each cable")
        if tension.shape != SIDES.shape or np.any(tension < 0):
            raise InvalidValueError("tension", self.tension, "finite, >= 0 N, one for each cable")
        if self.approach not in (-1, 0, 1):
            raise InvalidValueError("approach", self.approach, "-1, 0 or 1")
        object.__setattr__(self, "tension", tension)


class RestingArm:
    """The equations at rest in the unknowns y = (theta, z), joint angles and states of effects, (n + n_states,).

    Args:
        model: the model.
        equations: its compiled equations where they are there already.

    Raises:
        InvalidValueError: joint torques drive the model.
    """

    def __init__(self, model: Model, equations: CompiledEquations | None = None) -> None:
        model.require_cables("an arm that rests under its cables' pull")
        self.model = model
        self.equations = equations or CompiledEquations(model)
        self._p = parameter_vector(model)
        self._slots = parameter_slots(model)

    def unknowns(self, theta: Array, load: Load) -> Array:
        """y of an arm that rests in joint angles (n,) [rad], as far as its effects know."""
        p, parts = self.model.changed_parameters, [theta]
        parts += [active.effect.initial_state(theta, load.tension, active.values, p) for active in self.model.effects]
        return np.concatenate(parts)

    def pull(self, y: Array, load: Load, share: float = 1.0) -> tuple[Array, Array]:
        """Torque that friction has to hold, with what is left of the effects' equations, and its slope by y.

        Args:
            y: (n + n_states,).
            load: on the arm.
            share: of gravity and of the tensions that acts.

        Returns:
            (n + n_states,) [N m, ...], positive where a joint is bent too far, and (n + n_states, n + n_states).
        """
        n, p = self.model.n_joints, self._p.copy()
        p[self._slots["gravity"]] *= share
        if load.approach:
            p[self._slots["cable_slope"]] = _ANY_SPEED
        x = np.concatenate([y[:n], np.full(n, load.approach * _CREEP), y[n:]])
        r, _, by_x = self.equations.balance(x, np.zeros(y.size), share * load.tension, p)
        return r, np.delete(by_x, np.s_[n : 2 * n], axis=1)

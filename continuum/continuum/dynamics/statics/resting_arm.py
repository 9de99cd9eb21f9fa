"""The compiled equations of an arm at rest: joint torques without the joints' friction, and their derivative."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.compiled.equations import CompiledEquations
from continuum.dynamics.model import Model
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.dynamics.simulation_input import finite_array
from continuum.dynamics.values import parameter_slots, parameter_vector
from continuum.errors import InvalidValueError

_CREEP = 1e-12  # joint speed that sets the cables' sliding direction and is otherwise negligible [rad/s]
_ANY_SPEED = 1e18  # cable_slope at which this speed saturates the cables' friction [s/m]


@dataclass(frozen=True)
class Load:
    """Load on a resting arm.

    Attributes:
        tension: tension of each cable at the base, (n_cables,) [N], none negative.
        approach: last bending direction of all joints: 1 towards positive angles, -1 towards negative ones. It sets the
            direction of the tension losses over the discs (Eq. 15). 0: no losses.
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
        equations: compiled equations of the model if available.

    Raises:
        InvalidValueError: joint torques drive the model.
    """

    def __init__(self, model: Model, equations: CompiledEquations | None = None) -> None:
        model.require_cables("the equilibrium under cable tension")
        self.model = model
        self.equations = equations or CompiledEquations(model)
        self._p = parameter_vector(model)
        self._slots = parameter_slots(model)

    def unknowns(self, theta: Array, load: Load) -> Array:
        """Return y of an arm at rest at joint angles (n,) [rad], with the initial states of its effects."""
        p, parts = self.model.changed_parameters, [theta]
        parts += [active.effect.initial_state(theta, load.tension, active.values, p) for active in self.model.effects]
        return np.concatenate(parts)

    def pull(self, y: Array, load: Load, share: float = 1.0) -> tuple[Array, Array]:
        """Return the torque that friction has to hold, with the residual of the effects' equations, and the derivative.

        Args:
            y: joint angles and states of effects, (n + n_states,).
            load: load on the arm.
            share: fraction of gravity and of the tensions that acts.

        Returns:
            Residual (n + n_states,) [N m, ...], positive where a joint is bent beyond its equilibrium, and its
            derivative by y, (n + n_states, n + n_states).
        """
        n, p = self.model.n_joints, self._p.copy()
        p[self._slots["gravity"]] *= share
        if load.approach:
            p[self._slots["cable_slope"]] = _ANY_SPEED
        x = np.concatenate([y[:n], np.full(n, load.approach * _CREEP), y[n:]])
        r, _, by_x = self.equations.balance(x, np.zeros(y.size), share * load.tension, p)
        return r, np.delete(by_x, np.s_[n : 2 * n], axis=1)

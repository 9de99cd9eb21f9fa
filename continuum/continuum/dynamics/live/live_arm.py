"""A simulated arm that is moved on interval by interval: its state, and what one would measure of it."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.live.integrators import BdfStepper, EsdirkStepper
from continuum.dynamics.live.stepper import Interval, Stepper
from continuum.dynamics.model import Model
from continuum.dynamics.planar.cable_tension import SIDES, cable_lengths, cable_rates
from continuum.dynamics.simulation_input import initial_state
from continuum.dynamics.trajectory import SimulationStatus
from continuum.errors import InvalidValueError

INTEGRATORS: dict[str, type[BdfStepper] | type[EsdirkStepper]] = {"bdf": BdfStepper, "esdirk": EsdirkStepper}
"""By the names that users give: the thesis's method, and the fast one."""


class LiveArm:
    """Compiles the model's equations, which may take seconds, and rests in a posture until it is advanced.

    Args:
        model: what to simulate, with any effects.
        posture: joint angles at the start, (n,) [rad], or a whole state, as `initial_state` takes it.
        integrator: one of `INTEGRATORS`.
        tolerances: of integration; the thesis's without.

    Attributes:
        state: joint angles, joint rates, states of effects, (n_x,) [rad, rad/s, ...].

    Raises:
        InvalidValueError: an unknown integrator, a model that joint torques drive, a posture of another size, or one
            from which no motion is found.
        CompilerError: the model's equations cannot be compiled.
    """

    def __init__(
        self, model: Model, posture: object, integrator: str = "bdf", tolerances: Tolerances | None = None
    ) -> None:
        if integrator not in INTEGRATORS:
            raise InvalidValueError("integrator", integrator, "one of " + ", ".join(INTEGRATORS))
        model.require_cables("an arm that is pulled while it is simulated")
        self._model = model
        self.place(posture)
        self._stepper: Stepper = INTEGRATORS[integrator](model, tolerances or Tolerances())
        slack = np.zeros(len(SIDES))
        status, _ = self._stepper.advance(self.state, Interval(1e-3, slack, slack))  # compiles what is not compiled yet
        if status is not SimulationStatus.COMPLETE:
            raise InvalidValueError("posture", self.angles.tolist(), f"one that the model can leave; {status.value}")

    def place(self, posture: object) -> None:
        """Put the arm into a posture, at rest where only joint angles are given.

        Raises:
            InvalidValueError: another size, or not finite.
        """
        self.state = initial_state(self._model, posture)

    def advance(self, interval: Interval) -> SimulationStatus:
        """Move on; unless the status is COMPLETE the arm stays where it is."""
        status, reached = self._stepper.advance(self.state, interval)
        if status is SimulationStatus.COMPLETE:
            self.state = reached
        return status

    @property
    def angles(self) -> Array:
        """Of the joints, (n,) [rad]."""
        return self.state[: self._model.n_joints]

    @property
    def rates(self) -> Array:
        """Of the joints, (n,) [rad/s]."""
        n = self._model.n_joints
        return self.state[n : 2 * n]

    @property
    def cable_lengths(self) -> Array:
        """Of each cable from the base plate to the last disc, (n_cables,) [m]."""
        return cable_lengths(self.angles, self._model.parameters)

    @property
    def cable_rates(self) -> Array:
        """Their rates, positive when a cable gets longer, (n_cables,) [m/s]."""
        return cable_rates(self.angles, self.rates, self._model.parameters)

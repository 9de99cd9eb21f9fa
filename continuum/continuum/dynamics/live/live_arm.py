"""A simulated arm that advances interval by interval: its state and its measurable quantities."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.live.integrators import BdfStepper, EsdirkStepper
from continuum.dynamics.live.stepper import Interval, Stepper
from continuum.dynamics.model import Model
from continuum.dynamics.planar.cable_lengths import SIDES, cable_lengths, cable_rates
from continuum.dynamics.simulation_input import initial_state
from continuum.dynamics.trajectory import SimulationStatus
from continuum.errors import InvalidValueError

INTEGRATORS: dict[str, type[BdfStepper] | type[EsdirkStepper]] = {"bdf": BdfStepper, "esdirk": EsdirkStepper}
"""Integrators by the names in user settings: the thesis's method, and the fast one."""


class LiveArm:
    """A simulated arm at rest in a posture until `advance` moves it; its construction may take seconds to compile.

    Args:
        model: the model to simulate, with any effects.
        posture: joint angles at the start, (n,) [rad], or a complete state, as in `initial_state`.
        integrator: one of `INTEGRATORS`.
        tolerances: tolerances of the integration; None uses those of the thesis.

    Attributes:
        state: joint angles, joint rates, states of effects, (n_x,) [rad, rad/s, ...].

    Raises:
        InvalidValueError: the integrator is unknown, joint torques drive the model, the posture has the wrong size, or
            no motion is found from it.
        CompilerError: the model's equations cannot be compiled.
    """

    def __init__(
        self, model: Model, posture: object, integrator: str = "bdf", tolerances: Tolerances | None = None
    ) -> None:
        if integrator not in INTEGRATORS:
            raise InvalidValueError("integrator", integrator, "one of " + ", ".join(INTEGRATORS))
        model.require_cables("a live simulation with cable commands")
        self._model = model
        self.place(posture)
        self._stepper: Stepper = INTEGRATORS[integrator](model, tolerances or Tolerances())
        slack = np.zeros(len(SIDES))
        status, _ = self._stepper.advance(self.state, Interval(1e-3, slack, slack))  # compiles the remaining code
        if status is not SimulationStatus.COMPLETE:
            raise InvalidValueError(
                "posture", self.angles.tolist(), f"one from which the model can move; {status.value}"
            )

    def place(self, posture: object) -> None:
        """Place the arm in a posture; joint angles alone place it at rest.

        Raises:
            InvalidValueError: the posture has the wrong size or is not finite.
        """
        self.state = initial_state(self._model, posture)

    def advance(self, interval: Interval) -> SimulationStatus:
        """Advance by one interval; unless the status is COMPLETE, the state does not change."""
        status, reached = self._stepper.advance(self.state, interval)
        if status is SimulationStatus.COMPLETE:
            self.state = reached
        return status

    @property
    def angles(self) -> Array:
        """Joint angles, (n,) [rad]."""
        return self.state[: self._model.n_joints]

    @property
    def rates(self) -> Array:
        """Joint rates, (n,) [rad/s]."""
        n = self._model.n_joints
        return self.state[n : 2 * n]

    @property
    def cable_lengths(self) -> Array:
        """Length of each cable from the base plate to the last disc, (n_cables,) [m]."""
        return cable_lengths(self.angles, self._model.parameters)

    @property
    def cable_rates(self) -> Array:
        """Rate of each cable length, positive when the cable gets longer, (n_cables,) [m/s]."""
        return cable_rates(self.angles, self.rates, self._model.parameters)

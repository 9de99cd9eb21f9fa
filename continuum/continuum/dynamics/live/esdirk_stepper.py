"""The fast integrator, interval by interval: a one-step method, which loses nothing by beginning anew each time."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.live.stepper import Interval
from continuum.dynamics.model import Model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus


class EsdirkStepper:
    """Compiles the model's equations when it is made.

    Args:
        model: what to simulate.
        tolerances: of integration.
    """

    def __init__(self, model: Model, tolerances: Tolerances) -> None:
        self._simulator = Simulator(model, tolerances)

    def advance(self, x: Array, interval: Interval) -> tuple[SimulationStatus, Array]:
        """As `Stepper.advance`."""
        times = np.array([0.0, interval.duration])
        tensions = Tensions(times, np.stack([interval.before, interval.after]))
        done = self._simulator.run(x, times, tensions)
        return done.status, done.states[-1]

"""The two integrators, interval by interval: the fast one, and SciPy's BDF without a restart in each interval.

ESDIRK is a one-step method, which loses nothing by a restart in each interval. BDF is a multistep method: restarted in
every interval of 1/120 s, it would begin at order 1 with tiny steps each time. One solver object therefore persists,
and only its end time advances, so that its last step in an interval ends with the interval. Kinks of the tension, where
it starts or stops changing, are left to the solver's error control. The solver restarts where state or tension jump:
after a reset or a release.

Measured on the prototype: processor time for one second of simulated time at 120 intervals a second and the thesis's
tolerances, and the largest error of an angle against a converged solution:

============================  ================  ==================  ==================
one core                      release from 90°  tension of 0.7 Hz   straight, at rest
============================  ================  ==================  ==================
BDF, again for each interval  0.40 s, 0.139°    0.35 s, 0.046°      0.18 s
BDF that lives on             0.32 s, 0.021°    0.30 s, 0.020°      0.04 s
ESDIRK                        0.02 s, 0.0003°   0.02 s, 0.0002°     0.02 s
============================  ================  ==================  ==================
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.integrate import BDF
from scipy.linalg.lapack import dgetrf, dgetrs

from continuum.arrays import Array
from continuum.dynamics.compiled.equations import CompiledEquations
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.live.stepper import Interval
from continuum.dynamics.model import Model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus

_MOST_STEPS = 3000
"""Most steps in one interval; more would take too long for a live simulation."""

_REACHED = 1e-6
"""Fraction of an interval that needs no separate step."""


class EsdirkStepper:
    """The fast integrator; compiles the model's equations on construction.

    Args:
        model: the model to simulate.
        tolerances: tolerances of the integration.
    """

    def __init__(self, model: Model, tolerances: Tolerances) -> None:
        self._simulator = Simulator(model, tolerances)

    def advance(self, x: Array, interval: Interval) -> tuple[SimulationStatus, Array]:
        """As `Stepper.advance`."""
        times = np.array([0.0, interval.duration])
        tensions = Tensions(times, np.stack([interval.before, interval.after]))
        done = self._simulator.run(x, times, tensions)
        return done.status, done.states[-1]


class BdfStepper:
    """SciPy's BDF, which persists between intervals; compiles the model's equations on construction.

    Args:
        model: the model to simulate.
        tolerances: tolerances of the integration.
    """

    def __init__(self, model: Model, tolerances: Tolerances) -> None:
        self._equations = CompiledEquations(model)
        self._tolerances = tolerances
        self._solver: Any = None
        self._begin = 0.0  # of the interval, in the solver's time
        self._interval = Interval(1.0, np.zeros(0), np.zeros(0))

    def advance(self, x: Array, interval: Interval) -> tuple[SimulationStatus, Array]:
        """As `Stepper.advance`."""
        goes_on = self._goes_on(x, interval)
        self._begin = self._begin + self._interval.duration if goes_on else 0.0
        self._interval = interval
        end = self._begin + interval.duration
        try:
            with np.errstate(all="ignore"):  # the status reports it
                if not goes_on:
                    self._solver = self._new_solver(x, end)
                status = self._step_to(end)
        except ValueError:  # SciPy's linear algebra met values that are not finite
            status = SimulationStatus.NOT_FINITE
        if status is not SimulationStatus.COMPLETE:
            self._solver = None
            return status, x
        return status, np.asarray(self._solver.y)

    def _goes_on(self, x: Array, interval: Interval) -> bool:
        """Return whether the interval continues the previous one."""
        same_tension = np.array_equal(interval.before, self._interval.after)
        return self._solver is not None and same_tension and np.array_equal(x, self._solver.y)

    def _new_solver(self, x: Array, end: float) -> BDF:
        rates, jacobian, limits = self._equations.rates, self._equations.jacobian, self._tolerances
        solver = BDF(
            lambda t, y: rates(y, self._tension(t)),
            0.0,
            x,
            end,
            jac=lambda t, y: jacobian(y, self._tension(t)),
            rtol=limits.relative,
            atol=limits.absolute,
            max_step=limits.max_step,
        )
        # The LAPACK routines of SciPy's lu_factor and lu_solve, whose checks take far longer than these small systems.
        solver.lu = dgetrf
        solver.solve_lu = lambda factors, b: dgetrs(*factors[:2], b)[0]
        return solver

    def _step_to(self, end: float) -> SimulationStatus:
        solver = self._solver
        solver.t_bound, solver.status = end, "running"
        for _ in range(_MOST_STEPS):
            solver.step()
            if solver.status == "failed":
                return SimulationStatus.STEP_TOO_SMALL
            if end - solver.t <= _REACHED * self._interval.duration:
                return SimulationStatus.COMPLETE if np.all(np.isfinite(solver.y)) else SimulationStatus.NOT_FINITE
        return SimulationStatus.STEP_TOO_SMALL

    def _tension(self, t: float) -> Array:
        """Return the tension of each cable at the solver's time ``t`` [s], (n_cables,) [N]."""
        now = self._interval
        return now.before + (now.after - now.before) * min(max((t - self._begin) / now.duration, 0.0), 1.0)

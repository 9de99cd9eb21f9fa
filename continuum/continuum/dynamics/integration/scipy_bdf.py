"""The reference integrator: SciPy's BDF of order 1 to 5, as the thesis's ode15s (Shampine and Reichelt 1997)."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from continuum.arrays import Array
from continuum.dynamics.balance import numpy_state_space
from continuum.dynamics.compiled.equations import CompiledEquations
from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import Model
from continuum.dynamics.model_inputs import suitable_inputs
from continuum.dynamics.simulation_input import initial_state, output_times
from continuum.dynamics.trajectory import SimulationStatus, Trajectory


def simulate_bdf(
    model: Model,
    initial: Array,
    times: Array,
    inputs: InputSignal | None = None,
    tolerances: Tolerances | None = None,
    equations: CompiledEquations | None = None,
) -> Trajectory:
    """Simulate with SciPy's BDF.

    Args:
        model: the model to simulate.
        initial: complete state, or joint angles alone [rad].
        times: output times, (n_times,) [s].
        inputs: inputs that drive the arm; None drives it with nothing.
        tolerances: tolerances of the integration; None uses those of the thesis.
        equations: compiled rates and their exact Jacobian; None uses NumPy for the rates and finite differences for
            the Jacobian.

    Raises:
        InvalidValueError: the state or the times are not allowed, or the inputs do not suit the model.
    """
    x0, times = initial_state(model, initial), output_times(times)
    drive, limits = suitable_inputs(model, inputs), tolerances or Tolerances()
    rates = numpy_state_space(model) if equations is None else equations.rates
    jacobian = None if equations is None else (lambda t, x: equations.jacobian(x, drive.at(t)))
    nothing, no_sensitivities = np.full((times.size, x0.size), np.nan), np.zeros((times.size, x0.size, 0))
    try:
        done = solve_ivp(
            lambda t, x: rates(x, drive.at(t)),
            (times[0], times[-1]),
            x0,
            method="BDF",
            t_eval=times,
            dense_output=True,
            jac=jacobian,
            rtol=limits.relative,
            atol=limits.absolute,
            max_step=limits.max_step,
        )
    except ValueError:  # linear algebra met a matrix that is not finite or singular
        return Trajectory(SimulationStatus.NOT_FINITE, times, nothing, model.n_joints, 0, 0, no_sensitivities)
    status = SimulationStatus.COMPLETE if done.success else SimulationStatus.STEP_TOO_SMALL
    states = nothing
    states[: done.y.shape[1]] = done.y.T
    return Trajectory(status, times, states, model.n_joints, done.sol.ts.size - 1, 0, no_sensitivities)

"""The fast simulation of a model: its compiled equations and the ESDIRK integrator."""

from __future__ import annotations

from copy import copy

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.compiled.equations import CompiledEquations
from continuum.dynamics.compiled.machine_code import address_of
from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.integration.esdirk import STATUSES, integrate
from continuum.dynamics.integration.esdirk_tableau import Tableau, third_order
from continuum.dynamics.integration.problem import Method, Problem
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import Model
from continuum.dynamics.model_inputs import suitable_inputs
from continuum.dynamics.simulation_input import finite_array, initial_state, output_times
from continuum.dynamics.trajectory import Trajectory
from continuum.dynamics.values import parameter_vector
from continuum.errors import InvalidValueError


class Simulator:
    """Simulator that compiles a model's equations once and runs with any parameter values.

    Args:
        model: the model; its parameter values are the defaults of `run`.
        tolerances: tolerances of the integration.
        tableau: the Runge-Kutta method, of third order by default.
    """

    def __init__(self, model: Model, tolerances: Tolerances | None = None, tableau: Tableau | None = None) -> None:
        self.model = model
        self.tolerances = tolerances or Tolerances()
        self._tableau = tableau or third_order()
        self.equations = CompiledEquations(model)

    def around(self, model: Model) -> Simulator:
        """Return a simulator with the same compiled equations and the values of another model.

        Raises:
            InvalidValueError: the model differs in its effects, names of values, number of joints or inputs.
        """
        if _structure(model) != _structure(self.model):
            allowed = f"one with the values {', '.join(self.model.values())} and the same joints and inputs"
            raise InvalidValueError("model", ", ".join(model.values()), allowed)
        other = copy(self)
        other.model = model
        return other

    def run(
        self,
        initial: Array,
        times: Array,
        inputs: InputSignal | None = None,
        values: Array | None = None,
        free: Array | None = None,
        free_initial: Array | None = None,
    ) -> Trajectory:
        """Simulate from ``times[0]`` to ``times[-1]``.

        Args:
            initial: state at the first time, (2 n + n_states,) [rad, rad/s, ...]; angles alone start at rest.
            times: output times, increasing, (n_times,) [s].
            inputs: `Tensions` or `JointTorques`, as the model requires; None drives the arm with nothing.
            values: flat parameter values in the order of `parameter_vector`, (n_p,); those of the model by default.
            free: directions in these values by which to differentiate, (n_p, n_free).
            free_initial: derivative of the initial state with respect to the free quantities, (n_x, n_free).

        Raises:
            InvalidValueError: an argument has the wrong shape or is not finite, the times do not increase, or the
                inputs do not match the model.
        """
        n, drive = self.model.n_joints, suitable_inputs(self.model, inputs)
        x0, times = initial_state(self.model, initial), output_times(times)
        p = self._values(values)
        directions, sensitivity0 = self._free(p.size, x0.size, free, free_initial)
        equations, tableau, limits = self.equations, self._tableau, self.tolerances
        input_times, rows_of_inputs = drive.rows()
        rows, columns = np.nonzero(directions)
        problem = Problem(
            address_of(equations.residual), address_of(equations.stage),
            address_of(equations.sensitivities) if directions.shape[1] else 0,
            n, p, input_times - times[0], rows_of_inputs, rows, columns, directions[rows, columns],
        )  # fmt: skip
        method = Method(
            tableau.a, tableau.c, tableau.error, tableau.order, limits.relative, limits.absolute, limits.max_step,
            limits.most_steps,
        )  # fmt: skip
        states, sensitivities, taken, refused, status = integrate(
            problem, method, x0, times - times[0], np.ascontiguousarray(sensitivity0)
        )
        return Trajectory(STATUSES[status], times, states, n, taken, refused, sensitivities)

    def _values(self, given: Array | None) -> Array:
        """Parameter values, (n_p,)."""
        params = parameter_vector(self.model)
        if given is None:
            return params
        values = finite_array("values", given, f"{params.size} finite numbers")
        if values.shape != params.shape:
            raise InvalidValueError("values", given, f"{params.size} finite numbers")
        return values

    @staticmethod
    def _free(n_p: int, n_x: int, free: Array | None, free_initial: Array | None) -> tuple[Array, Array]:
        """Directions (n_p, n_free) in the parameters, and (n_x, n_free) in the initial state."""
        if free is None:
            free = np.zeros((n_p, 0))
        directions = finite_array("free", free, f"finite numbers, ({n_p}, n_free)")
        if directions.ndim != 2 or directions.shape[0] != n_p:
            raise InvalidValueError("shape of free", directions.shape, f"({n_p}, n_free)")
        wanted = (n_x, directions.shape[1])
        sensitivity0 = finite_array(
            "free_initial", np.zeros(wanted) if free_initial is None else free_initial, str(wanted)
        )
        if sensitivity0.shape != wanted:
            raise InvalidValueError("shape of free_initial", sensitivity0.shape, str(wanted))
        return directions, sensitivity0


def _structure(model: Model) -> tuple[object, ...]:
    """Return the properties of a model that are compiled in."""
    effects = tuple(active.effect.name for active in model.effects)
    return model.inputs, effects, tuple((name, len(value)) for name, value in model.values().items())

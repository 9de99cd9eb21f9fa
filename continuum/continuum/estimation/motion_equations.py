"""Eq. 12 and its derivatives along a given motion, compiled from the same effects that the simulator integrates.

Dry friction depends on a separate rate, the slip rate: it has the value of the joint's rate but no derivative by it,
since friction's sign is known along a given motion. So nothing stiff is differentiated.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import casadi
import numpy as np

from continuum.arrays import Array
from continuum.dynamics.balance import balance
from continuum.dynamics.compiled.machine_code import address_of, found_or_compiled
from continuum.dynamics.compiled.structure_key import structure_key
from continuum.dynamics.compiled.symbolic_balance import SymbolicBalance, TracedMotion, column, symbols
from continuum.dynamics.integration.compiled_loops import call_at
from continuum.dynamics.model import Model
from continuum.dynamics.values import parameter_vector
from continuum.estimation.compiled_loops import entry_point


@dataclass(frozen=True)
class _SlidingMotion(TracedMotion):
    slip: Any = None
    joint_rates: Any = None

    @property
    def slip_rate(self) -> Any:
        """The joints' rates as separate symbols, with what effects add to them."""
        given, named = column(self.joint_rates), column(self.slip)
        return np.array([casadi.substitute(casadi.SX(rate), given, named) for rate in self.theta_rate], dtype=object)


class _TracedEquations(SymbolicBalance):
    """Functions of one packed vector (x, v, u, slip, p)."""

    def __init__(self, model: Model) -> None:
        n, extra, still = model.n_joints, model.n_states, np.zeros(1)
        x, v, slip = symbols("x", 2 * n + extra), symbols("v", n + extra), symbols("slip", n)
        u = symbols("u", model.n_inputs)
        values = {name: symbols(name, len(value)) for name, value in model.values().items()}
        motion = _SlidingMotion(x[:n], x[n : 2 * n], v[:n], still, still, still, slip=slip, joint_rates=x[n : 2 * n])
        self._r = column(balance(model.built_from(values), x, v, u, motion))
        self._sums = list(motion.sums.values())
        self._x, self._v, self._p = column(x), column(v), column(np.concatenate(list(values.values())))
        self._n = n
        self._packed = casadi.vertcat(self._x, self._v, column(u), column(slip), self._p)
        self._step = casadi.SX.sym("step")

    def torque(self) -> casadi.Function:
        return self._function("torque", [])

    def linear(self) -> casadi.Function:
        return self._function("linear", [self._derivative(s) for s in (self._v, self._x)])

    def inertia(self) -> casadi.Function:
        return self._function("inertia", [self._derivative(self._v)])

    def by_parameters(self) -> casadi.Function:
        return self._function("by_parameters", [self._derivative(self._p)])

    def state_step(self) -> casadi.Function:
        n = self._n
        of_states = self._r[n:]
        z, z_rate = self._x[2 * n :], self._v[n:]
        matrix = casadi.jacobian(of_states, z) + self._step * casadi.jacobian(of_states, z_rate)
        wanted = casadi.vertcat(of_states, casadi.mldivide(matrix, -of_states))
        for joints, sums in self._sums:
            wanted = casadi.substitute(wanted, column(sums), casadi.cumsum(column(joints)))
        packed = casadi.vertcat(self._packed, self._step)
        return casadi.Function("state_step", [packed], [casadi.densify(wanted)])


class MotionEquations:
    """Compiled functions of one packed vector (x, v, u, slip, p), for a model's structure; p are arguments.

    x: angles, rates, effects' states, (2 n + n_states,); v: accelerations and rates of the states, (n + n_states,);
    u: inputs, (n_inputs,); slip: rates for dry friction, (n,); p: parameter values, (n_p,).

    Args:
        model: model whose effects and number of joints are compiled in.

    Attributes:
        n_states, n_inputs, n_p: numbers of effects' states, of inputs, and of parameter values.
    """

    def __init__(self, model: Model) -> None:
        self._model, self._key = model, structure_key(model, Path(__file__))
        self.n_states, self.n_inputs = model.n_states, model.n_inputs
        self.n_p = sum(len(value) for value in model.values().values())

    @cached_property
    def torque(self) -> Any:
        """r, (n + n_states,)."""
        return self._machine_code(_TracedEquations.torque)

    @cached_property
    def linear(self) -> Any:
        """r, dr/dv, dr/dx, for a model whose effects have no states."""
        return self._machine_code(_TracedEquations.linear)

    @cached_property
    def inertia(self) -> Any:
        """r, dr/dv."""
        return self._machine_code(_TracedEquations.inertia)

    @cached_property
    def by_parameters(self) -> Any:
        """r, dr/dp."""
        return self._machine_code(_TracedEquations.by_parameters)

    @cached_property
    def state_step(self) -> Any:
        """r_s and Newton's step of the states z alone in an implicit Euler step: z' = (z - z_before) / step.

        Its argument is the packed vector and 1 / step [1/s]. The linear system is solved while the code is made, so
        that its sparsity, usually one small block for each joint, costs nothing at run time.
        """
        return self._machine_code(_TracedEquations.state_step)

    @cached_property
    def _traced(self) -> _TracedEquations:
        return _TracedEquations(self._model)

    def _machine_code(self, function: Callable[[_TracedEquations], casadi.Function]) -> Any:
        return found_or_compiled(self._key, function.__qualname__, lambda: function(self._traced))


def packed(
    motion: Array, u: Array, slip: Array, p: Array, z: Array | None = None, z_rate: Array | None = None
) -> Array:
    """Return rows for the compiled functions, (rows, size).

    Args:
        motion: angles, rates, accelerations, (rows, 3, n) [rad, rad/s, rad/s2].
        u: inputs, (rows, n_inputs).
        slip: rates for dry friction, (rows, n) [rad/s].
        p: parameter values, (n_p,).
        z, z_rate: states of effects and their rates, (rows, n_states).
    """
    rows = len(motion)
    none = np.zeros((rows, 0))
    z, z_rate = none if z is None else z, none if z_rate is None else z_rate
    given = [motion[:, 0], motion[:, 1], z, motion[:, 2], z_rate, u, slip, np.broadcast_to(p, (rows, p.size))]
    return np.ascontiguousarray(np.hstack(given))


def evaluate(function: Any, given: Array, size: int) -> Array:
    """Evaluate a compiled function of every row of ``given``, (rows, size)."""
    out = np.empty((len(given), size))
    _evaluate(address_of(function), given, out)
    return out


@entry_point
def _evaluate(address: int, given: Array, out: Array) -> None:
    for k in range(given.shape[0]):
        call_at(address, given[k], out[k])


def torques(equations: MotionEquations, rows: Array, n: int) -> Array:
    """Return the torque missing in Eq. 12, -r at the joints, (rows, n) [N m]."""
    return -evaluate(equations.torque, rows, n + equations.n_states)[:, :n]


def values_of(model: Model) -> Array:
    """Return the model's parameter values in the order of the packed vector, (n_p,)."""
    return parameter_vector(model)

"""A model's equations as compiled functions of NumPy arrays: balance, rates (Eq. 18) and their exact Jacobian."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.compiled.machine_code import found_or_compiled
from continuum.dynamics.compiled.structure_key import structure_key
from continuum.dynamics.compiled.symbolic_balance import SymbolicBalance
from continuum.dynamics.model import Model
from continuum.dynamics.values import parameter_vector

_NO_STAGE = np.zeros(1)  # h g


class CompiledEquations:
    """Compiled equations of a model's structure; parameter values are arguments.

    Args:
        model: its effects and number of joints are compiled in; its values are the defaults.
    """

    def __init__(self, model: Model) -> None:
        self.n_joints = model.n_joints
        self.n_rates = model.n_joints + model.n_states
        self.n_x = self.n_rates + model.n_joints
        self.n_inputs = model.n_inputs
        self.values = parameter_vector(model)
        self._model, self._key = model, structure_key(model)

    @cached_property
    def _symbols(self) -> SymbolicBalance:
        return SymbolicBalance(self._model)

    @cached_property
    def residual(self) -> Any:
        """Machine code of `SymbolicBalance.residual`."""
        return self._machine_code("residual")

    @cached_property
    def stage(self) -> Any:
        """Machine code of `SymbolicBalance.stage`."""
        return self._machine_code("stage")

    @cached_property
    def newton(self) -> Any:
        """Machine code of `SymbolicBalance.newton`."""
        return self._machine_code("newton")

    @cached_property
    def sensitivities(self) -> Any:
        """Machine code of `SymbolicBalance.sensitivities`, compiled on first use."""
        return self._machine_code("sensitivities")

    def _machine_code(self, name: str) -> Any:
        return found_or_compiled(self._key, name, lambda: getattr(self._symbols, name))

    def balance(self, x: Array, v: Array, u: Array, p: Array | None = None) -> tuple[Array, Array, Array]:
        """r (n_v,), dr/dv (n_v, n_v), dr/dx (n_v, n_x) at state x, rates v, inputs u, parameter values p."""
        m = self.n_rates
        out = self._call(self.newton, m * (1 + m + self.n_x), x, v, u, p)
        return out[:m], out[m : m + m * m].reshape(m, m).T, out[m + m * m :].reshape(self.n_x, m).T

    def parameter_jacobian(self, x: Array, v: Array, u: Array, p: Array | None = None) -> Array:
        """dr/dp, (n_v, n_p)."""
        m, n_p = self.n_rates, self.values.size
        out = self._call(self.sensitivities, m * (1 + m + self.n_x + n_p), x, v, u, p)
        return out[m * (1 + m + self.n_x) :].reshape(n_p, m).T

    def rates(self, x: Array, u: Array, p: Array | None = None) -> Array:
        """Eq. 18: (theta', theta'', z'), (n_x,).

        Raises:
            ValueError: the equations are not finite, or do not determine the rates.
        """
        r, by_v, _ = self.balance(x, np.zeros(self.n_rates), u, p)
        if not (np.isfinite(r).all() and np.isfinite(by_v).all()):
            raise ValueError("the equations are not finite")
        return np.concatenate([x[self.n_joints : 2 * self.n_joints], -np.linalg.solve(by_v, r)])

    def jacobian(self, x: Array, u: Array, p: Array | None = None) -> Array:
        """Exact jacobian of the rates at a state, (n_x, n_x): r = 0 gives dv/dx = -(dr/dv)^-1 dr/dx."""
        n = self.n_joints
        _, by_v, by_x = self.balance(x, self.rates(x, u, p)[n:], u, p)
        kinematic = np.zeros((n, self.n_x))
        kinematic[:, n : 2 * n] = np.eye(n)
        return np.concatenate([kinematic, -np.linalg.solve(by_v, by_x)])

    def _call(self, function: Any, size: int, x: Array, v: Array, u: Array, p: Array | None) -> Array:
        packed = np.concatenate([x, v, u, self.values if p is None else p, _NO_STAGE])
        if (
            packed.size != self.n_x + self.n_rates + self.n_inputs + self.values.size + 1
        ):  # the machine code does not check sizes
            raise ValueError(f"state, rates, inputs and parameters have {packed.size - 1} numbers, a wrong total")
        out = np.empty(size)
        function(packed.ctypes.data, out.ctypes.data)
        return out

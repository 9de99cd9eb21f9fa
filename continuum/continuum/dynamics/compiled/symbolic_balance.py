"""A model's equations traced once with symbols, and their exact derivatives.

The links' absolute angles are sums of joint angles, so a derivative by joint angles taken through them fills up:
every term depends on every joint before it. Hence the sums are symbols of their own here, whose derivatives are
sparse, and the chain rule adds them up along the joints: for n joints some n^2 operations, not n^3.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import casadi
import numpy as np

from continuum.dynamics.balance import balance
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.model import Model
from continuum.dynamics.planar.cables import SIDES
from continuum.dynamics.planar.motion import Motion


@dataclass(frozen=True)
class _TracedMotion(Motion):
    """A motion that notes which symbols stand for sums of which others."""

    sums: dict[tuple[str, ...], tuple[Numbers, Numbers]] = field(default_factory=dict)

    def summed(self, joints: Numbers) -> Numbers:
        if not all(isinstance(joint, casadi.SX) and joint.is_symbolic() for joint in joints):
            return super().summed(joints)  # an effect's own angles
        key = tuple(str(joint) for joint in joints)
        if key not in self.sums:
            self.sums[key] = (joints, _symbols(f"sum_{len(self.sums)}", len(joints)))
        return self.sums[key][1]


class SymbolicBalance:
    """Functions of one packed vector: state x, rates v, tensions u, parameters p, in this order.

    Each gives one packed vector, matrices by columns. Parameter values do not matter, their number does.
    """

    def __init__(self, model: Model) -> None:
        n, extra, still = model.n_joints, model.n_states, np.zeros(1)
        x, v, u = _symbols("x", 2 * n + extra), _symbols("v", n + extra), _symbols("u", len(SIDES))
        values = {name: _symbols(name, len(value)) for name, value in model.values().items()}
        motion = _TracedMotion(x[:n], x[n : 2 * n], v[:n], still, still, still)
        self._r = _column(balance(model.built_from(values), x, v, u, motion))
        self._sums = list(motion.sums.values())
        self._x, self._v, self._p = _column(x), _column(v), _column(np.concatenate(list(values.values())))
        self._packed = casadi.vertcat(self._x, self._v, _column(u), self._p)

    @cached_property
    def newton(self) -> casadi.Function:
        """r, dr/dv, dr/dx."""
        return self._function("newton", [self._v, self._x])

    @cached_property
    def slopes(self) -> casadi.Function:
        """r, dr/dv, dr/dx, dr/dp."""
        return self._function("slopes", [self._v, self._x, self._p])

    def _function(self, name: str, by: list[Any]) -> casadi.Function:
        wanted = casadi.vertcat(self._r, *(self._derivative(symbols) for symbols in by))
        for joints, sums in self._sums:
            wanted = casadi.substitute(wanted, _column(sums), casadi.cumsum(_column(joints)))
        return casadi.Function(name, [self._packed], [casadi.densify(wanted)])

    def _derivative(self, by: Any) -> Any:
        """dr/d by, its columns one below the other."""
        whole = casadi.jacobian(self._r, by)
        names = [str(by[i]) for i in range(by.numel())]
        for joints, sums in self._sums:
            if str(joints[0]) in names:  # d sum_k / d joint_i is 1 for k >= i: sum the columns from the last
                through = casadi.cumsum(casadi.densify(casadi.jacobian(self._r, _column(sums)))[:, ::-1], 1)[:, ::-1]
                whole = casadi.densify(whole)
                whole[:, [names.index(str(joint)) for joint in joints]] += through
        return casadi.vec(casadi.densify(whole))


def _symbols(name: str, size: int) -> Numbers:
    return np.array([casadi.SX.sym(f"{name}_{i}") for i in range(size)], dtype=object)


def _column(symbols: Numbers) -> Any:
    return casadi.densify(casadi.vertcat(*symbols))

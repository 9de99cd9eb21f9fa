"""A model's equations traced once with symbols, and their exact derivatives.

The links' absolute angles are sums of joint angles, so derivatives by joint angles through these sums are dense: every
term depends on every preceding joint. The sums are therefore separate symbols with sparse derivatives, and the chain
rule adds these along the joints: for n joints about n^2 operations instead of n^3.
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
from continuum.dynamics.planar.instant import Motion


@dataclass(frozen=True)
class TracedMotion(Motion):
    """A motion that records which symbols stand for the sums of which others."""

    sums: dict[tuple[str, ...], tuple[Numbers, Numbers]] = field(default_factory=dict)

    def summed(self, joints: Numbers) -> Numbers:
        if not all(isinstance(joint, casadi.SX) and joint.is_symbolic() for joint in joints):
            return super().summed(joints)  # angles that an effect defines
        key = tuple(str(joint) for joint in joints)
        if key not in self.sums:
            self.sums[key] = (joints, symbols(f"sum_{len(self.sums)}", len(joints)))
        return self.sums[key][1]


class SymbolicBalance:
    """Functions of one packed vector: state x, rates v, inputs u, parameters p, and h g [s] of an implicit stage.

    Each returns one packed vector, matrices column by column. The functions depend on the number of parameter values,
    not on the values. The stage matrix is the derivative of r with respect to the rates v when the state moves with
    them, theta' and z by h g, theta by (h g)^2: J = dr/dv + h g dr/d(theta', z) + (h g)^2 dr/dtheta.
    """

    def __init__(self, model: Model) -> None:
        n, extra, still = model.n_joints, model.n_states, np.zeros(1)
        x, v, u = symbols("x", 2 * n + extra), symbols("v", n + extra), symbols("u", model.n_inputs)
        values = {name: symbols(name, len(value)) for name, value in model.values().items()}
        motion = TracedMotion(x[:n], x[n : 2 * n], v[:n], still, still, still)
        self._r = column(balance(model.built_from(values), x, v, u, motion))
        self._sums = list(motion.sums.values())
        self._x, self._v, self._p = column(x), column(v), column(np.concatenate(list(values.values())))
        self._n, self._hg = n, casadi.SX.sym("hg")
        self._packed = casadi.vertcat(self._x, self._v, column(u), self._p, self._hg)

    @cached_property
    def residual(self) -> casadi.Function:
        """r."""
        return self._function("residual", [])

    @cached_property
    def stage(self) -> casadi.Function:
        """r, J; J is computed as one derivative, which costs less than its three summands."""
        return self._function("stage", [self._stage_matrix()])

    @cached_property
    def newton(self) -> casadi.Function:
        """r, dr/dv, dr/dx."""
        return self._function("newton", [self._derivative(self._v), self._derivative(self._x)])

    @cached_property
    def sensitivities(self) -> casadi.Function:
        """r, J, dr/dx, dr/dp."""
        by_v, by_x, by_p = (self._derivative(symbols) for symbols in (self._v, self._x, self._p))
        J = by_v + self._hg * by_x[:, self._n :]
        J[:, : self._n] += self._hg**2 * by_x[:, : self._n]
        return self._function("sensitivities", [J, by_x, by_p])

    def _function(self, name: str, matrices: list[Any]) -> casadi.Function:
        wanted = casadi.vertcat(self._r, *(casadi.vec(casadi.densify(matrix)) for matrix in matrices))
        for joints, sums in self._sums:
            wanted = casadi.substitute(wanted, column(sums), casadi.cumsum(column(joints)))
        return casadi.Function(name, [self._packed], [casadi.densify(wanted)])

    def _derivative(self, by: Any) -> Any:
        """dr/d by, (n_v, n_by)."""
        whole = casadi.densify(casadi.jacobian(self._r, by))
        names = _names(by)
        for joints, sums in self._sums:
            if str(joints[0]) in names:
                through = _through_sums(casadi.jacobian(self._r, column(sums)))
                whole[:, [names.index(str(joint)) for joint in joints]] += through
        return whole

    def _stage_matrix(self) -> Any:
        """J, (n_v, n_v)."""
        n, hg, size = self._n, self._hg, self._v.numel()
        moved, summed = casadi.SX.sym("moved", size), casadi.SX.sym("summed", n)
        given, where = [self._x, self._v], [self._x + _state_moved(moved, hg, n), self._v + moved]
        x, v = _names(self._x), _names(self._v)
        weight = dict.fromkeys(x[:n], hg**2) | dict.fromkeys(x[n:], hg) | dict.fromkeys(v, 1.0)
        for joints, sums in self._sums:
            given.append(column(sums))
            where.append(column(sums) + weight.get(str(joints[0]), 0.0) * summed)
        (r,) = casadi.substitute([self._r], given, where)
        both = casadi.densify(casadi.jacobian(r, casadi.vertcat(moved, summed)))
        J = both[:, :size]
        J[:, :n] += _through_sums(both[:, size:])
        return casadi.substitute(J, casadi.vertcat(moved, summed), casadi.SX.zeros(size + n))


def _through_sums(by_sums: Any) -> Any:
    """Convert a derivative with respect to sums into one for the joints: d sum_k / d joint_i is 1 for k >= i."""
    return casadi.cumsum(casadi.densify(by_sums)[:, ::-1], 1)[:, ::-1]


def _state_moved(moved: Any, hg: Any, n: int) -> Any:
    """Return the change of a stage's state (theta, theta', z) by a change of its rates (theta'', z')."""
    return casadi.vertcat(hg**2 * moved[:n], hg * moved)


def _names(symbols: Any) -> list[str]:
    return [str(symbols[i]) for i in range(symbols.numel())]


def symbols(name: str, size: int) -> Numbers:
    return np.array([casadi.SX.sym(f"{name}_{i}") for i in range(size)], dtype=object)


def column(parts: Numbers) -> Any:
    return casadi.densify(casadi.vertcat(*parts))

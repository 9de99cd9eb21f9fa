"""Thesis Eq. 18: Eq. 12 in state space, solved for the accelerations.

The balance is linear in the rates v = (theta'', z') that it is solved for: r = r(v = 0) + (dr/dv) v. For the thesis's
own model dr/dv is M; where effects add states or inertia, its columns are the balance at unit rates.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from continuum.arrays import Array
from continuum.dynamics.balance import balance
from continuum.dynamics.model import Model
from continuum.dynamics.planar.eq12_inertia_matrix import inertia_matrix

StateSpace = Callable[[Array, Array], Array]
"""Rates of a state (n_x,) under inputs (n_inputs,): (theta', theta'', z'), (n_x,) [rad/s, rad/s2, ...]."""


def numpy_state_space(model: Model) -> StateSpace:
    """Eq. 18 of a model, evaluated term by term in NumPy as the equations are written."""
    n, size = model.n_joints, model.n_joints + model.n_states
    unit = np.eye(size)

    def rates(x: Array, u: Array) -> Array:
        rest = balance(model, x, np.zeros(size), u)
        if model.effects:
            matrix = np.stack([balance(model, x, column, u) - rest for column in unit], axis=1)
        else:
            matrix = inertia_matrix(np.cumsum(x[:n]), model.parameters)
        return np.concatenate([x[n : 2 * n], -lu_solve(lu_factor(matrix), rest)])

    return rates

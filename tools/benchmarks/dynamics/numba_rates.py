"""Eq. 18's rates and exact Jacobian for scikit-sundae: numba functions around a model's machine code."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba
import numpy as np

from continuum.arrays import Array
from continuum.dynamics.integration.compiled_loops import call_at
from continuum.dynamics.planar.cable_lengths import SIDES


def rates_and_jacobian(newton: int, n: int, p: Array) -> tuple[Callable[..., Any], Callable[..., Any]]:
    """``f(t, x, rates)`` and ``jacobian(t, x, rates, J)``, slack cables, of the machine code at ``newton``."""
    packed, out = np.concatenate([np.zeros(3 * n + SIDES.size), p, [0.0]]), np.empty(n * (1 + 3 * n))

    @numba.njit
    def solved(x, v, packed, out):  # type: ignore[no-untyped-def]
        packed[: 2 * n] = x
        packed[2 * n : 3 * n] = v
        call_at(newton, packed, out)
        return np.ascontiguousarray(out[n : n + n * n].reshape(n, n).T)

    @numba.njit
    def rates_of(x, rates, packed, out):  # type: ignore[no-untyped-def]
        M = solved(x, np.zeros(n), packed, out)
        rates[:n] = x[n:]
        rates[n:] = -np.linalg.solve(M, out[:n].copy())

    @numba.njit
    def jacobian_of(x, rates, J, packed, out):  # type: ignore[no-untyped-def]
        M = solved(x, rates[n:], packed, out)
        J[:] = 0.0
        for i in range(n):
            J[i, n + i] = 1.0
        J[n:] = -np.linalg.solve(M, np.ascontiguousarray(out[n + n * n :].reshape(2 * n, n).T))

    def f(_: float, x: Array, rates: Array) -> None:
        rates_of(x, rates, packed, out)

    def jacobian(_: float, x: Array, rates: Array, J: Array) -> None:
        jacobian_of(x, rates, J, packed, out)

    return f, jacobian

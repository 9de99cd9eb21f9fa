"""A convex quadratic programme: few unknowns, few active bounds."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array


def bounded_minimum(A: Array, b: Array, G: Array, least: Array) -> tuple[Array, float]:
    """argmin of x'Ax / 2 - b'x with G x >= least by an active set, and by how much the bounds raise the minimum."""
    free = np.linalg.solve(A, b)
    Y = np.linalg.solve(A, G.T)
    active: list[int] = []
    x = free
    for _ in range(3 * len(G)):
        slack = G @ x - least
        slack[active] = 0.0
        worst = int(np.argmin(slack)) if slack.size else -1
        if worst < 0 or slack[worst] > -1e-9:
            break
        active.append(worst)
        while active:
            inner = G[active] @ Y[:, active]
            forces = np.linalg.lstsq(inner, least[active] - G[active] @ free, rcond=1e-10)[0]
            if forces.min() >= 0:
                break
            active.pop(int(np.argmin(forces)))
        x = free + Y[:, active] @ forces if active else free
    away = x - free
    return x, float(0.5 * away @ A @ away)

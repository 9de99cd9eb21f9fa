"""A convex quadratic programme with few unknowns and few active constraints."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array

_SLACK = 1e-9  # by which a constraint may be violated
_DEPENDENT = 1e-12  # fraction of a constraint's curvature below which it depends on the active ones


def bounded_minimum(A: Array, b: Array, G: Array, least: Array) -> tuple[Array, float]:
    """Minimise x'Ax / 2 - b'x subject to G x >= least; return x, and by how much the constraints raise the minimum.

    Dual active set (Goldfarb and Idnani, Mathematical Programming 27, 1983): from the free minimum, the most violated
    constraint is made active; one whose multiplier would turn negative on the way is dropped. If no point satisfies all
    constraints, the last point is returned.
    """
    free = np.linalg.solve(A, b)
    if not len(G):
        return free, 0.0
    Y = np.linalg.solve(A, G.T)
    x, active, multipliers = free.copy(), list[int](), np.zeros(0)
    for _ in range(20 * (len(G) + 1)):
        slack = G @ x - least
        worst = int(np.argmin(slack))
        if slack[worst] > -_SLACK:
            break
        pushed = 0.0
        while True:
            step, release = _directions(G, Y, active, worst)
            curvature = float(G[worst] @ step)
            is_free = curvature > _DEPENDENT * float(G[worst] @ Y[:, worst])
            full = -float(G[worst] @ x - least[worst]) / curvature if is_free else np.inf
            partial, dropped = _first_to_leave(multipliers, release)
            length = min(full, partial)
            if not np.isfinite(length):
                return x, _rise(A, x - free)
            if is_free:
                x = x + length * step
            multipliers, pushed = multipliers - length * release, pushed + length
            if full <= partial:
                active.append(worst)
                multipliers = np.append(multipliers, pushed)
                break
            active.pop(dropped)
            multipliers = np.delete(multipliers, dropped)
    return x, _rise(A, x - free)


def _directions(G: Array, Y: Array, active: list[int], worst: int) -> tuple[Array, Array]:
    """Return the step of x along the active constraints, and the fall of their multipliers, per unit of the new one."""
    if not active:
        return Y[:, worst], np.zeros(0)
    release = np.linalg.lstsq(G[active] @ Y[:, active], G[active] @ Y[:, worst], rcond=_DEPENDENT)[0]
    return Y[:, worst] - Y[:, active] @ release, release


def _first_to_leave(multipliers: Array, release: Array) -> tuple[float, int]:
    """Return the length at which the first multiplier reaches zero, and its index; infinite if none does."""
    falling = np.flatnonzero(release > 1e-14)
    if not falling.size:
        return np.inf, -1
    lengths = multipliers[falling] / release[falling]
    at = int(np.argmin(lengths))
    return float(lengths[at]), int(falling[at])


def _rise(A: Array, away: Array) -> float:
    return float(0.5 * away @ A @ away)

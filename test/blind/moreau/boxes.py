"""Impulses between bounds: the set-valued laws of one time step.

Row i has an impulse p_i within [lo_i, hi_i] and a velocity u_i = (u_free + W p)_i, measured from the one that it wants:
u_i = 0 strictly between the bounds, u_i >= 0 at the lower one, u_i <= 0 at the upper one. This is where the convex
1/2 p'W p + p'u_free is least in the box. Projected Gauss-Seidel sweeps find which rows are between their bounds; the
rows that are so are then solved exactly, so far as the box lets it (gradient projection with subspace minimisation,
More & Toraldo 1991), until nothing changes.
"""

import numpy as np

from blind.moreau.compiled import compiled

SWEEPS = 3
ROUNDS = 200
DEPENDENT = 1e-10  # pivot over diagonal, below which a row follows from those before it


@compiled
def solve_boxed(
    W: np.ndarray, free: np.ndarray, lo: np.ndarray, hi: np.ndarray, p: np.ndarray, tolerance: float
) -> bool:
    """Find the impulses from a first guess within the bounds.

    Args:
        W: velocity by impulse (n, n), symmetric, positive semidefinite.
        free: velocities without impulses (n,).
        lo: lower bounds (n,).
        hi: upper bounds (n,).
        p: guess, becomes the impulses (n,).
        tolerance: of velocities.

    Returns:
        Whether every velocity fits its impulse within the tolerance.
    """
    n = free.size
    u = free + W @ p
    chosen, factor, move = np.empty(n, np.int64), np.empty((n, n)), np.empty(n)
    for _ in range(ROUNDS):
        for _ in range(SWEEPS):
            sweep(W, lo, hi, p, u)
        count = factorise_inner(W, lo, hi, p, chosen, factor)
        solve_lower(factor, chosen, u, move, count)
        share = 1.0
        for a in range(count):
            i = chosen[a]
            if p[i] + move[a] > hi[i]:
                share = min(share, (hi[i] - p[i]) / move[a])
            elif p[i] + move[a] < lo[i]:
                share = min(share, (lo[i] - p[i]) / move[a])
        for a in range(count):
            i = chosen[a]
            p[i] = min(max(p[i] + share * move[a], lo[i]), hi[i])
        u[:] = free + W @ p
        if share == 1.0 and fits(lo, hi, p, u, tolerance):
            return True
    return False


@compiled
def sweep(W: np.ndarray, lo: np.ndarray, hi: np.ndarray, p: np.ndarray, u: np.ndarray) -> None:
    """Once through all rows: each impulse to where it makes its velocity zero, or to its bound."""
    for i in range(p.size):
        if hi[i] > lo[i] and W[i, i] > 0.0:
            before = p[i]
            p[i] = min(max(before - u[i] / W[i, i], lo[i]), hi[i])
            change = p[i] - before
            if change != 0.0:
                for k in range(p.size):
                    u[k] += W[k, i] * change


@compiled
def factorise_inner(
    W: np.ndarray, lo: np.ndarray, hi: np.ndarray, p: np.ndarray, chosen: np.ndarray, factor: np.ndarray
) -> int:
    """Cholesky factor of independent rows between their bounds, which ``chosen`` lists; their number."""
    count = 0
    for i in range(p.size):
        if lo[i] < p[i] < hi[i]:
            pivot = W[i, i]
            for a in range(count):
                value = W[i, chosen[a]]
                for c in range(a):
                    value -= factor[count, c] * factor[a, c]
                factor[count, a] = value / factor[a, a]
                pivot -= factor[count, a] ** 2
            if pivot > DEPENDENT * W[i, i]:
                factor[count, count] = np.sqrt(pivot)
                chosen[count] = i
                count += 1
    return count


@compiled
def solve_lower(factor: np.ndarray, chosen: np.ndarray, u: np.ndarray, move: np.ndarray, count: int) -> None:
    """Change of the chosen impulses after which their velocities are zero."""
    for a in range(count):
        value = -u[chosen[a]]
        for c in range(a):
            value -= factor[a, c] * move[c]
        move[a] = value / factor[a, a]
    for a in range(count - 1, -1, -1):
        value = move[a]
        for c in range(a + 1, count):
            value -= factor[c, a] * move[c]
        move[a] = value / factor[a, a]


@compiled
def fits(lo: np.ndarray, hi: np.ndarray, p: np.ndarray, u: np.ndarray, tolerance: float) -> bool:
    """Whether every velocity is one that its impulse allows."""
    for i in range(p.size):
        if hi[i] > lo[i] and ((u[i] > tolerance and p[i] > lo[i]) or (u[i] < -tolerance and p[i] < hi[i])):
            return False
    return True

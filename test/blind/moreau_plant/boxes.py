"""Impulses between bounds: the set-valued laws of one time step.

Row i has an impulse p_i within [lo_i, hi_i] and a velocity u_i = (free + W p)_i, measured from the one that it wants:
u_i = 0 strictly between the bounds, u_i >= 0 at the lower one, u_i <= 0 at the upper one. There the convex
1/2 p'W p + p'free is least in the box. Sweeps of projected Gauss-Seidel guess which rows are between their bounds;
these are solved exactly so far as the box lets them, a row that meets its bound stays there, and whichever row's
velocity is the most wrong leaves it, until none is.
"""

import numpy as np

from blind.moreau_plant.compiled import compiled

SWEEPS = 2
ROUNDS = 300  # a dozen is the most that was seen
DEPENDENT = 1e-12  # pivot over diagonal, below which a row follows from those before it


@compiled
def solve_boxed(
    W: np.ndarray, free: np.ndarray, lo: np.ndarray, hi: np.ndarray, p: np.ndarray, tolerance: float
) -> bool:
    """Find the impulses from a first guess within the bounds.

    Args:
        W: velocity by impulse (n, n), symmetric, positive semidefinite.
        free: velocities without impulses (n,).
        lo: lower bounds (n,).
        hi: upper bounds (n,), above the lower ones.
        p: guess, becomes the impulses (n,).
        tolerance: of velocities.

    Returns:
        Whether every velocity fits its impulse within the tolerance.
    """
    n = free.size
    u, move = np.empty(n), np.empty(n)
    chosen, factor, inside = np.empty(n, np.int64), np.empty((n, n)), np.empty(n, np.bool_)
    velocities(W, free, p, u)
    for _ in range(SWEEPS):
        sweep(W, lo, hi, p, u)
    for i in range(n):
        inside[i] = lo[i] < p[i] < hi[i]
    for _ in range(ROUNDS):
        count = factorise_inner(W, inside, chosen, factor)
        solve_inner(factor, chosen, u, move, count)
        met = go(lo, hi, p, chosen, move, count)
        velocities(W, free, p, u)
        if met >= 0:
            inside[met] = False
            continue
        wrong = most_wrong(lo, hi, p, u, tolerance)
        if wrong < 0:
            return True
        if inside[wrong]:
            return False
        inside[wrong] = True
    return False


@compiled
def velocities(W: np.ndarray, free: np.ndarray, p: np.ndarray, u: np.ndarray) -> None:
    """With the impulses (n,) that there are."""
    for i in range(p.size):
        u[i] = free[i]
        for k in range(p.size):
            u[i] += W[i, k] * p[k]


@compiled
def sweep(W: np.ndarray, lo: np.ndarray, hi: np.ndarray, p: np.ndarray, u: np.ndarray) -> None:
    """Once through all rows: each impulse to where it makes its velocity zero, or to its bound."""
    for i in range(p.size):
        if W[i, i] > 0.0:
            before = p[i]
            p[i] = min(max(before - u[i] / W[i, i], lo[i]), hi[i])
            change = p[i] - before
            if change != 0.0:
                for k in range(p.size):
                    u[k] += W[k, i] * change


@compiled
def factorise_inner(W: np.ndarray, inside: np.ndarray, chosen: np.ndarray, factor: np.ndarray) -> int:
    """Cholesky factor of independent rows between their bounds, which ``chosen`` lists; their number."""
    count = 0
    for i in range(inside.size):
        if inside[i]:
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
def solve_inner(factor: np.ndarray, chosen: np.ndarray, u: np.ndarray, move: np.ndarray, count: int) -> None:
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
def go(lo: np.ndarray, hi: np.ndarray, p: np.ndarray, chosen: np.ndarray, move: np.ndarray, count: int) -> int:
    """Change the chosen impulses until one meets its bound: that row, or -1 where none does."""
    share, met = 1.0, -1
    for a in range(count):
        i = chosen[a]
        room = (hi[i] if move[a] > 0.0 else lo[i]) - p[i]
        if abs(move[a]) * share > abs(room):
            share, met = room / move[a], a
    for a in range(count):
        i = chosen[a]
        p[i] = min(max(p[i] + share * move[a], lo[i]), hi[i])
    if met < 0:
        return -1
    p[chosen[met]] = hi[chosen[met]] if move[met] > 0.0 else lo[chosen[met]]
    return chosen[met]


@compiled
def most_wrong(lo: np.ndarray, hi: np.ndarray, p: np.ndarray, u: np.ndarray, tolerance: float) -> int:
    """The row whose impulse allows its velocity least, or -1 where all do within the tolerance."""
    worst, row = tolerance, -1
    for i in range(p.size):
        if (u[i] > worst and p[i] > lo[i]) or (u[i] < -worst and p[i] < hi[i]):
            worst, row = abs(u[i]), i
    return row

"""The set-valued laws of a step: directions of impulses, their bounds, and the velocities that they lead to."""

from typing import NamedTuple

import numpy as np

from blind.moreau.boxes import solve_boxed
from blind.moreau.cables import belt_limits
from blind.moreau.chain import Chain
from blind.moreau.cholesky import back, factorise, forward
from blind.moreau.compiled import compiled
from blind.moreau.joints import push
from blind.moreau.mechanism import Mechanism
from blind.moreau.state import CABLES, ROWS, STOPS, State
from blind.plant.parameters import JOINTS

TOLERANCE = 1e-12  # of velocities, over the largest one without impulses or 1


class Laws(NamedTuple):
    """Rows as ``state`` orders them; a row whose bounds are equal does nothing.

    Attributes:
        direction: velocity by rates of the hinges (ROWS, n).
        low: lower bounds of the impulses (ROWS,).
        high: upper ones (ROWS,).
        wanted: velocities between the bounds (ROWS,).
    """

    direction: np.ndarray
    low: np.ndarray
    high: np.ndarray
    wanted: np.ndarray


@compiled
def no_laws(n: int) -> Laws:
    """Rows for ``n`` hinges, to be filled in."""
    return Laws(np.zeros((ROWS, n)), np.zeros(ROWS), np.zeros(ROWS), np.zeros(ROWS))


@compiled
def rub(laws: Laws, row: int, most: float) -> None:
    """Friction of at most this impulse in a row whose direction is known."""
    laws.low[row], laws.high[row] = -most, most


@compiled
def rub_joints(laws: Laws, chain: Chain, dry: np.ndarray, dt: float) -> None:
    """Dry friction (5,) [N m] at the joints' hinges."""
    for i in range(JOINTS):
        laws.direction[i, chain.hinge[i]] = 1.0
        rub(laws, i, dt * dry[i])


@compiled
def rub_cables(
    laws: Laws, m: Mechanism, chain: Chain, state: State, angle: np.ndarray, chords: np.ndarray, dt: float
) -> np.ndarray:
    """Friction of the cables at the discs: on the chords beyond; the tensions across the joints a step ago (2, 5) [N].

    Args:
        laws: rows to fill in.
        m: with the coefficient of friction.
        chain: which hinges a joint has.
        state: with tensions at the base now, friction a step ago.
        angle: of the joints (5,) [rad].
        chords: length of each chord by its joint's angle (2, 5) [m/rad].
        dt: time step [s].
    """
    friction = state.impulse[CABLES:STOPS].reshape(2, JOINTS) / dt
    limit = belt_limits(angle, state.pulling, friction, m.cable_friction)
    tension = np.empty((2, JOINTS))
    for c in range(2):
        left = state.pulling[c]
        for k in range(JOINTS):
            left -= friction[c, k]
            tension[c, k] = left
            row = CABLES + c * JOINTS + k
            rub(laws, row, dt * limit[c, k])
            for i in range(k, JOINTS):
                push(chain, i, chords[c, i], laws.direction[row])
    return tension


@compiled
def stop_plays(laws: Laws, chain: Chain, q: np.ndarray, dt: float) -> None:
    """Hinges at angles (n,) [rad] that turn between stops: not beyond them by the end of the step."""
    for i in range(JOINTS):
        k = chain.link[i]
        if chain.stop[k] < np.inf:
            for way in range(2):
                row, sign = STOPS + 2 * i + way, 1.0 - 2.0 * way
                laws.direction[row, k] = sign
                laws.high[row] = np.inf
                laws.wanted[row] = -(chain.stop[k] + sign * q[k]) / dt


@compiled
def move(laws: Laws, state: State, mass: np.ndarray, impulse: np.ndarray) -> np.ndarray:
    """Rates of the hinges (n,) after a step [rad/s]; impulses and heat go to the state.

    Args:
        laws: rows of the step.
        state: with rates before the step, and the last step's impulses to begin from.
        mass: matrix of the step (n, n) [kg m^2]; overwritten.
        impulse: of everything but the laws (n,) [N m s].
    """
    n = impulse.size
    rows = np.flatnonzero(laws.high > laws.low)
    factorise(mass)
    forward(mass, impulse)
    inner = np.empty((rows.size, n))  # L^-1 J', with M = L L'
    for r in range(rows.size):
        inner[r] = laws.direction[rows[r]]
        forward(mass, inner[r])
    free = np.empty(rows.size)
    for r in range(rows.size):
        free[r] = laws.direction[rows[r]] @ state.v + inner[r] @ impulse - laws.wanted[rows[r]]
    low, high = laws.low[rows], laws.high[rows]
    p = np.minimum(np.maximum(state.impulse[rows], low), high)
    if rows.size > 0:
        tolerance = TOLERANCE * max(1.0, np.abs(free).max())
        state.unsolved[0] += not solve_boxed(inner @ inner.T, free, low, high, p, tolerance)
    for r in range(rows.size):
        impulse += p[r] * inner[r]
    back(mass, impulse)
    rate = state.v + impulse
    state.impulse[:] = 0.0
    for r in range(rows.size):
        row = rows[r]
        if row < JOINTS and low[r] < p[r] < high[r]:  # holds: zero but for rounding
            rate[np.argmax(laws.direction[row])] = 0.0
        state.impulse[row] = p[r]
    for row in rows:
        state.rubbed[0] -= state.impulse[row] * (laws.direction[row] @ rate)
    return rate

"""The set-valued laws of a step: directions of impulses, their bounds, and the velocities that they lead to."""

from typing import NamedTuple

import numpy as np

from blind.moreau_plant.boxes import solve_boxed
from blind.moreau_plant.cables import belt_limits
from blind.moreau_plant.chain import Chain
from blind.moreau_plant.compiled import compiled
from blind.moreau_plant.joints import push
from blind.moreau_plant.linear import back, dot, factorise, forward
from blind.moreau_plant.mechanism import Mechanism
from blind.moreau_plant.state import CABLES, DISCS, ROWS, STOPS, State
from blind.mujoco_plant.parameters import JOINTS

TOLERANCE = 1e-9  # of velocities, over the largest one without impulses or 1


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
    """Friction of the cables at the discs, each on the chords beyond.

    Args:
        laws: rows to fill in.
        m: with the coefficient of friction.
        chain: which hinges a joint has.
        state: with tensions at the base now, friction a step ago.
        angle: of the joints (5,) [rad].
        chords: length of each chord by its joint's angle (2, 5) [m/rad].
        dt: time step [s].

    Returns:
        Both tensions together across each joint, a step ago (5,) [N].
    """
    friction = np.empty((2, JOINTS))
    for c in range(2):
        for k in range(JOINTS):
            friction[c, k] = state.impulse[CABLES + c * JOINTS + k] / dt
    limit = belt_limits(angle, state.pulling, friction, m.cable_friction)
    tension = np.zeros(JOINTS)
    for c in range(2):
        left = state.pulling[c]
        for k in range(JOINTS):
            left -= friction[c, k]
            tension[k] += left
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
def stop_discs(laws: Laws, m: Mechanism, chain: Chain, angle: np.ndarray) -> None:
    """Joints at angles (5,) [rad] bend no farther than where their discs' holes meet."""
    most = 2 * np.arctan2(m.half_spacing, m.hole_radius)
    for i in range(JOINTS):
        if abs(angle[i]) > most:
            laws.high[DISCS + i] = np.inf
            push(chain, i, -np.sign(angle[i]), laws.direction[DISCS + i])


@compiled
def move(laws: Laws, chain: Chain, state: State, mass: np.ndarray, impulse: np.ndarray) -> np.ndarray:
    """Rates of the hinges (n,) after a step [rad/s]; impulses and heat go to the state.

    Args:
        laws: rows of the step.
        chain: which hinges rub.
        state: with rates before the step, and the last step's impulses to begin from.
        mass: matrix of the step (n, n) [kg m^2]; overwritten.
        impulse: of everything but the laws (n,) [N m s].
    """
    rows = np.empty(ROWS, np.int64)
    count = 0
    for row in range(ROWS):
        if laws.high[row] > laws.low[row]:
            rows[count] = row
            count += 1
    factorise(mass)
    forward(mass, impulse)
    inner = np.empty((count, impulse.size))  # L^-1 J', with M = L L'
    free, low, high, p = np.empty(count), np.empty(count), np.empty(count), np.empty(count)
    W = np.empty((count, count))
    tolerance = 1.0
    for r in range(count):
        row = rows[r]
        inner[r] = laws.direction[row]
        forward(mass, inner[r])
        free[r] = dot(laws.direction[row], state.v) + dot(inner[r], impulse) - laws.wanted[row]
        low[r], high[r] = laws.low[row], laws.high[row]
        p[r] = min(max(state.impulse[row], low[r]), high[r])
        tolerance = max(tolerance, abs(free[r]))
        for s in range(r + 1):
            W[r, s] = W[s, r] = dot(inner[r], inner[s])
    if count > 0:
        state.unsolved[0] += not solve_boxed(W, free, low, high, p, TOLERANCE * tolerance)
    for r in range(count):
        for k in range(impulse.size):
            impulse[k] += p[r] * inner[r, k]
    back(mass, impulse)
    rate = state.v + impulse
    state.impulse[:] = 0.0
    for r in range(count):
        state.impulse[rows[r]] = p[r]
        if rows[r] < JOINTS and low[r] < p[r] < high[r]:  # holds: zero but for rounding
            rate[chain.hinge[rows[r]]] = 0.0
    for r in range(count):
        state.rubbed[0] -= p[r] * dot(laws.direction[rows[r]], rate)
    return rate

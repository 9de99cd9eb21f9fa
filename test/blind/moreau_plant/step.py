"""One time step after Moreau: velocities by impulses between bounds, positions by the trapezoidal rule.

With the midpoint q_m = q + h/2 v and all smooth torques f there, springs and dampers implicit in the change of v,

    (M(q_m) + h/2 C + h^2/4 K) (v' - v) = h f(q_m, v) + sum_i J_i' p_i,      q' = q_m + h/2 v',

p_i the impulses of the set-valued laws: |p_i| <= h tau_i of joints that rub, and so on. A joint that holds has the rate
zero and nothing else. Hinges with stops move by q' = q + h v', so that they arrive at a stop and stay there.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from blind.moreau_plant.cables import lengths, sensitivities
from blind.moreau_plant.chain import Chain, equations, gravity, to_hinges
from blind.moreau_plant.compiled import compiled, digest_of_sources, kept
from blind.moreau_plant.joints import add_magnets_and_rubbing, add_presliding, add_springs, angles, dry_friction, push
from blind.moreau_plant.laws import Laws, move, no_laws, rub, rub_cables, rub_joints, stop_discs, stop_plays
from blind.moreau_plant.linear import dot
from blind.moreau_plant.loads import carried
from blind.moreau_plant.mechanism import Mechanism
from blind.moreau_plant.state import STRAP, State
from blind.moreau_plant.surroundings import STRAP_DAMPING, STRAP_FRICTION, add_drag, strap
from blind.moreau_plant.winches import pulls
from blind.mujoco_plant.parameters import JOINTS


@compiled
def step(m: Mechanism, chain: Chain, state: State, command: np.ndarray, let_go: bool, dt: float) -> None:
    """Advance by ``dt`` [s] under commanded tensions (2,) [N], with both cables free at the base if ``let_go``."""
    v, n = state.v, state.q.size
    middle = state.q.copy()
    for k in range(n):
        if chain.stop[k] == np.inf:
            middle[k] += 0.5 * dt * v[k]
    turned, rate = np.cumsum(middle), np.cumsum(v)
    angle = angles(chain, turned)
    time = state.time[0] + 0.5 * dt
    load = m.load + (m.dropping if time < m.drop_at else 0.0)
    pull = gravity(m, time)
    speeding = np.cumsum(state.acceleration)

    mass, torque, slope, laws = np.empty((n, n)), np.empty(n), np.zeros(n), no_laws(n)
    equations(chain, load, turned, rate + 0.5 * dt * speeding, pull, mass, torque)
    if m.drag > 0.0:
        dragged = np.zeros(n)
        add_drag(m, chain, turned, rate, dragged)
        to_hinges(dragged)
        torque += dragged
    torque -= chain.viscous * v
    add_springs(m, chain, state, middle, torque, slope)
    tension = np.zeros(JOINTS)
    if let_go:
        state.pulling[:] = 0.0
    else:
        state.pulling[:] = pulls(m, state, command, lengths(angle, m.hole_radius, m.half_spacing), dt)
        if state.pulling.any():
            chords = sensitivities(angle, m.hole_radius, m.half_spacing)
            tension = rub_cables(laws, m, chain, state, angle, chords, dt)
            for i in range(JOINTS):
                push(chain, i, -state.pulling[0] * chords[0, i] - state.pulling[1] * chords[1, i], torque)
    loads = np.zeros(JOINTS)
    if m.load_friction > 0.0:
        loads = carried(chain, load, turned, rate, speeding, pull, tension)
    dry = dry_friction(m, chain, v + 0.5 * dt * state.acceleration, loads)
    add_magnets_and_rubbing(m, chain, angle, dry, torque)
    if m.presliding > 0.0:
        add_presliding(m, chain, state, middle, dry, torque, slope)
    rub_joints(laws, chain, dry, dt)
    if m.strap > 0.0:
        add_strap(m, chain, turned, v, torque, mass, laws, dt)
    stop_plays(laws, chain, state.q, dt)
    stop_discs(laws, m, chain, angle)
    for k in range(n):
        mass[k, k] += 0.5 * dt * chain.viscous[k] + 0.25 * dt**2 * slope[k]

    after = move(laws, chain, state, mass, dt * torque)
    for k in range(n):
        state.q[k] = middle[k] + (dt if chain.stop[k] < np.inf else 0.5 * dt) * after[k]
        state.acceleration[k] = (after[k] - v[k]) / dt
        v[k] = after[k]
    state.time[0] += dt


@compiled
def add_strap(
    m: Mechanism,
    chain: Chain,
    turned: np.ndarray,
    rate: np.ndarray,
    torque: np.ndarray,
    mass: np.ndarray,
    laws: Laws,
    dt: float,
) -> None:
    """Add the strap at absolute angles (n,) [rad] and rates of the hinges (n,) [rad/s] to a step's terms."""
    stretch, direction = strap(m, chain, turned)
    damping = STRAP_DAMPING * m.strap
    force = m.strap * stretch + damping * dot(direction, rate)
    for k in range(rate.size):
        torque[k] -= force * direction[k]
        for j in range(rate.size):
            mass[k, j] += (0.5 * dt * damping + 0.25 * dt**2 * m.strap) * direction[k] * direction[j]
    laws.direction[STRAP] = direction
    rub(laws, STRAP, dt * STRAP_FRICTION * m.strap)


@cache
def compiled_advance() -> Callable[..., Any]:
    """The loop over steps, compiled where it has not been before."""
    digest = digest_of_sources()

    @kept
    def advance(
        m: Mechanism,
        chain: Chain,
        state: State,
        first: np.ndarray,
        last: np.ndarray,
        let_go: bool,
        dt: float,
        steps: int,
        angle: np.ndarray,
        rate: np.ndarray,
    ) -> str:
        """Advance while tensions go from ``first`` to ``last`` (2,) [N], by ``steps`` of ``dt`` [s].

        Absolute angles [rad] and rates [rad/s] of the links at so many instants, evenly from the beginning on, go to
        ``angle`` and ``rate`` (k, 5). What it returns, the sources' digest, is there to be a part of the cache's key.
        """
        every = steps // len(angle)
        for part in range(steps):
            if part % every == 0:
                turned, turning = np.cumsum(state.q), np.cumsum(state.v)
                for i in range(JOINTS):
                    angle[part // every, i] = turned[chain.link[i]]
                    rate[part // every, i] = turning[chain.link[i]]
            step(m, chain, state, first + (last - first) * (part / steps), let_go, dt)
        return digest

    return advance

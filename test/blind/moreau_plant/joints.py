"""Torques at the joints: springs, what acts on their angles, friction that gives before it slips; dry friction."""

import numpy as np

from blind.moreau_plant.chain import Chain
from blind.moreau_plant.compiled import compiled
from blind.moreau_plant.mechanism import Mechanism
from blind.moreau_plant.state import ELEMENTS, State
from blind.mujoco_plant.parameters import JOINTS

MAGNET_AT, MAGNET_WIDTH = np.radians(9.0), np.radians(3.0)
RUBS_PAST = np.radians(3.0)
RUBBING_PUSH = 0.5  # of the rubbing disc's elasticity, over its dry friction
SNAPS_OVER, SNAPS_BACK = np.radians(10.0), np.radians(4.0)


@compiled
def angles(chain: Chain, turned: np.ndarray) -> np.ndarray:
    """Of the joints (5,) from absolute ones of the bodies (n,); of rates alike."""
    angle = np.empty(JOINTS)
    for i in range(JOINTS):
        before = chain.hinge[i] - 1
        angle[i] = turned[chain.link[i]] - (turned[before] if before >= 0 else 0.0)
    return angle


@compiled
def push(chain: Chain, joint: int, amount: float, torque: np.ndarray) -> None:
    """Add a torque between the links of a joint (from 0), beyond its play, to those of the hinges (n,) [N m]."""
    for k in range(chain.hinge[joint], chain.link[joint] + 1):
        torque[k] += amount


@compiled
def add_springs(m: Mechanism, chain: Chain, state: State, q: np.ndarray, torque: np.ndarray, slope: np.ndarray) -> None:
    """Add the springs' torques at angles (n,) [rad] to ``torque`` (n,) [N m], their stiffness to ``slope`` (n,)."""
    for k in range(q.size):
        torque[k] -= chain.stiffness[k] * (q[k] - chain.rest[k])
        slope[k] += chain.stiffness[k]
    for i in range(JOINTS):
        k = chain.hinge[i]
        bent = q[k] - chain.rest[k]
        torque[k] -= chain.stiffness[k] * m.hardening * bent**3
        slope[k] += chain.stiffness[k] * m.hardening * 3 * bent**2
        if m.kink[i] > 0.0:
            state.snapped[i] = abs(q[k]) > (SNAPS_BACK if state.snapped[i] else SNAPS_OVER)
            if state.snapped[i]:
                torque[k] += m.kink[i] * chain.stiffness[k] * q[k]
                slope[k] -= m.kink[i] * chain.stiffness[k]


@compiled
def add_magnets_and_rubbing(m: Mechanism, chain: Chain, angle: np.ndarray, dry: np.ndarray, torque: np.ndarray) -> None:
    """Add what acts on the joints' angles (5,) [rad] to the torques (n,) and to the joints' dry friction (5,) [N m]."""
    for i in range(JOINTS):
        if m.magnet[i] > 0.0:
            x = (angle[i] - MAGNET_AT) / MAGNET_WIDTH
            push(chain, i, -m.magnet[i] * x * np.exp(0.5 * (1 - x * x)), torque)
        beyond = angle[i] - RUBS_PAST
        if m.rubbing[i] > 0.0 and beyond > 0.0:
            dry[i] += m.rubbing[i] * beyond
            push(chain, i, -RUBBING_PUSH * m.rubbing[i] * beyond, torque)


@compiled
def dry_friction(m: Mechanism, chain: Chain, rate: np.ndarray, carried: np.ndarray) -> np.ndarray:
    """Most that each joint's friction holds (5,) [N m].

    Args:
        m: with tau_c (1 + S / (1 + |w / v_d|^p)) + r F.
        chain: which hinges rub.
        rate: of the hinges (n,) [rad/s].
        carried: force F between the links (5,) [N].
    """
    dry = np.empty(JOINTS)
    for i in range(JOINTS):
        speed = abs(rate[chain.hinge[i]]) / m.stribeck_rate[i]
        dry[i] = m.coulomb[i] * (1 + m.stribeck[i] / (1 + speed**m.stribeck_exponent)) + m.load_friction * carried[i]
    return dry


@compiled
def add_presliding(
    m: Mechanism, chain: Chain, state: State, q: np.ndarray, dry: np.ndarray, torque: np.ndarray, slope: np.ndarray
) -> None:
    """Friction by Maxwell-slip elements: equal springs, each slipping at its share of the joint's dry friction.

    The shares are those of element angles spread evenly from 0 to twice the mean one. Torques go to ``torque`` (n,),
    the stiffness of elements that hold to ``slope`` (n,); nothing is left of ``dry`` (5,).
    """
    for i in range(JOINTS):
        k = chain.hinge[i]
        spring = m.coulomb[i] / (m.presliding * ELEMENTS)
        moved = q[k] - state.before[i]
        state.before[i] = q[k]
        for e in range(ELEMENTS):
            most = dry[i] * (2 * e + 1) / ELEMENTS**2
            tried = state.held[i, e] + spring * moved
            state.held[i, e] = min(max(tried, -most), most)
            torque[k] -= state.held[i, e]
            if state.held[i, e] == tried:
                slope[k] += spring
        dry[i] = 0.0

"""What changes while the arm moves."""

from typing import NamedTuple

import numpy as np

from blind.moreau_plant.cables import lengths
from blind.moreau_plant.chain import Chain
from blind.moreau_plant.mechanism import Mechanism
from blind.mujoco_plant.parameters import JOINTS

ELEMENTS = 16  # of a joint's friction that gives before it slips
# rows of a step's impulses: friction of joints, strap and cables at the discs, stops of plays, discs that meet
STRAP = JOINTS
CABLES = STRAP + 1
STOPS = CABLES + 2 * JOINTS
DISCS = STOPS + 2 * JOINTS
ROWS = DISCS + JOINTS


class State(NamedTuple):
    """Arrays that a step overwrites; n hinges.

    Attributes:
        q: angles of the hinges (n,) [rad].
        v: their rates (n,) [rad/s].
        acceleration: their rates' change over the last step (n,) [rad/s^2].
        time: since the first row (1,) [s].
        impulse: of every law's row in the last step (ROWS,) [N m s or N s].
        pulling: tensions at the base (2,) [N].
        lagging: tensions behind the lag (2,) [N].
        sagging: sag of the cables (2,) [m].
        reeled: by winches of elastic cables (2,) [m].
        length: of the cables (2,) [m].
        straight: the same of the straight arm (2,) [m].
        held: torque of each element of joints that give before they slip (5, ELEMENTS) [N m].
        before: angles of their hinges when it was (5,) [rad].
        snapped: whether each joint's spring has kinked (5,).
        rubbed: heat of all dry friction and of stops so far (1,) [J].
        unsolved: steps whose impulses miss the tolerance (1,).
    """

    q: np.ndarray
    v: np.ndarray
    acceleration: np.ndarray
    time: np.ndarray
    impulse: np.ndarray
    pulling: np.ndarray
    lagging: np.ndarray
    sagging: np.ndarray
    reeled: np.ndarray
    length: np.ndarray
    straight: np.ndarray
    held: np.ndarray
    before: np.ndarray
    snapped: np.ndarray
    rubbed: np.ndarray
    unsolved: np.ndarray


def at_rest(m: Mechanism, chain: Chain) -> State:
    """The straight arm at rest, long before a recording begins."""
    n = chain.length.size
    straight = lengths(np.zeros(JOINTS), m.hole_radius, m.half_spacing)
    return State(
        q=np.zeros(n),
        v=np.zeros(n),
        acceleration=np.zeros(n),
        time=np.array([-1e3]),
        impulse=np.zeros(ROWS),
        pulling=np.zeros(2),
        lagging=np.zeros(2),
        sagging=np.full(2, float(m.sag)),
        reeled=np.zeros(2),
        length=straight.copy(),
        straight=straight,
        held=np.zeros((JOINTS, ELEMENTS)),
        before=np.zeros(JOINTS),
        snapped=np.zeros(JOINTS, dtype=np.bool_),
        rubbed=np.zeros(1),
        unsolved=np.zeros(1, dtype=np.int64),
    )

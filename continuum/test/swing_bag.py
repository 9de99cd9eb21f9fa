"""A section of three joints that sways and two cables that pull it, as topics of a recording."""

from typing import Any

import numpy as np
from recorded_runs import START, TYPES, Topics, message

ROWS, JOINTS = 90, 3
T = np.arange(ROWS) / 120
STAMPS = START + np.round(T * 1e9).astype(np.int64)
PHASES = np.arange(JOINTS)
ANGLES, RATES = 0.3 * np.cos(6 * T[:, None] + PHASES), -1.8 * np.sin(6 * T[:, None] + PHASES)
PULL = np.stack([4 - 3 * np.sin(5 * T), 4 + 3 * np.sin(5 * T)], axis=1)
JOINT_NAMES = ["section_1_phi", *(f"section_1_theta_{j + 1}" for j in range(JOINTS)), "section_1_phi_back"]
CABLE_NAMES = ["section_1_cable_1", "section_1_cable_2"]


def swing() -> Topics:
    """Three joints that sway and two cables, as the node publishes them."""
    topics: Topics = {"/joint_states": [], "/cable_states": []}
    for stamp, angles, rates, pull in zip(STAMPS, ANGLES, RATES, PULL, strict=True):
        topics["/joint_states"].append(
            message(
                TYPES["/joint_states"],
                stamp,
                name=list(JOINT_NAMES),
                position=np.concatenate([[0.0], angles, [0.0]]),
                velocity=np.concatenate([[0.0], rates, [0.0]]),
            )
        )
        topics["/cable_states"].append(
            message(TYPES["/cable_states"], stamp, name=list(CABLE_NAMES), position=np.ones(2), effort=pull)
        )
    return topics


def stamped(one: Any, stamp: int) -> None:
    one.header.stamp.sec, one.header.stamp.nanosec = divmod(int(stamp), 10**9)

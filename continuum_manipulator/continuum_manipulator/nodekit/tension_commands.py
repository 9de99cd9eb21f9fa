"""Tension commands: the effort of `continuum_msgs/CableStates`, by cable name and in any order.

The type is the one in which cables are told of everywhere in the workspace, so what is commanded and the `cable_states`
that answer can be recorded, plotted and compared field by field; ``effort`` is where `sensor_msgs/JointState` and all
that is made after it keep forces. Only header, names and efforts are looked at: a recorded `cable_states` is a command.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.arrays import Array
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.faults import MessageFault
from continuum_manipulator.nodekit.stamps import NANOSECONDS, nanoseconds, seconds
from continuum_msgs.msg import CableStates

STALE = "stale stamp"


def read_tensions(message: CableStates, cables: Sequence[str], now: int, patience: float) -> Array:
    """The tension commanded for each of the cables, (n_cables,) [N], finite and none negative.

    Args:
        message: the command.
        cables: names of the cables; the command must have each of them once, and no other.
        now: ROS time [ns].
        patience: how far the stamp may be from now [s].

    Raises:
        MessageFault: the command is none of these.
    """
    messages.stamped(message.header.stamp)
    messages.named(message.name, "cables", cables)
    messages.same_length("effort", message.effort, message.name)
    order = messages.indices_of(cables, message.name)
    messages.no_others(cables, message.name)
    tensions = messages.finite("effort", np.asarray(message.effort)[order])
    if np.any(tensions < 0):
        i = int(np.argmin(tensions))
        raise MessageFault(messages.REFUSED, f"effort of {cables[i]} is {tensions[i]}; a cable pulls: >= 0 N")
    age = (now - nanoseconds(message.header.stamp)) / NANOSECONDS
    if abs(age) > patience:
        where = f"{age:.3f} s old" if age > 0 else f"{-age:.3f} s in the future"
        raise MessageFault(STALE, f"{where} at {seconds(now)}; allowed: {patience:g} s")
    return tensions

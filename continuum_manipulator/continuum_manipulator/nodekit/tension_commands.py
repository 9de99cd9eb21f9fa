"""Tension commands: the effort of `continuum_msgs/CableStates`, by cable name and in any order.

All cable data in the workspace have this type, so commands and the resulting `cable_states` can be recorded, plotted
and compared field by field; ``effort`` holds forces as in `sensor_msgs/JointState`. Only header, names and efforts are
used: a recorded `cable_states` can serve as a command.
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
LATE = "handled too late"


def read_tensions(message: CableStates, cables: Sequence[str], arrival: int, patience: float) -> Array:
    """Return the commanded tension of each cable, (n_cables,) [N], finite and not negative.

    A command is as old as it was on its arrival: a node that handles it late does not blame the sender. It holds no
    longer for that, see `held_for`.

    Args:
        message: the command.
        cables: names of the cables; the command must contain each of them once, and no others.
        arrival: ROS time of its arrival [ns], as `CheckedNode.arrival` returns it.
        patience: largest difference between the stamp and the arrival [s].

    Raises:
        MessageFault: the command is invalid or stale.
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
    age = (arrival - nanoseconds(message.header.stamp)) / NANOSECONDS
    if abs(age) > patience:
        where = f"{age:.3f} s old" if age > 0 else f"{-age:.3f} s in the future"
        raise MessageFault(STALE, f"{where} on arrival at {seconds(max(0, arrival))}; allowed: {patience:g} s")
    return tensions


def held_for(message: CableStates, arrival: int, now: int, patience: float) -> float:
    """Return for how long a command of `read_tensions` has held at a time ``now`` [ns], in s.

    It holds from its stamp on, or from its arrival if that was earlier. One that has timed out while it waited in this
    node would pull no longer, but begin anew a release that is under way.

    Raises:
        MessageFault: the command has timed out.
    """
    held = (now - min(arrival, nanoseconds(message.header.stamp))) / NANOSECONDS
    if held > patience:
        raise MessageFault(
            LATE, f"this node came to it when it was {held:.3f} s old; a command holds for {patience:g} s"
        )
    return held

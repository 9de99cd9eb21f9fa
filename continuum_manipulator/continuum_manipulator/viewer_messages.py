"""Checked contents of the messages that the viewer shows."""

from __future__ import annotations

from collections.abc import Collection

from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import JointState

from continuum.arrays import Array
from continuum.viewer.seen import Status
from continuum_manipulator.nodekit import messages
from continuum_manipulator.section_joints import read_names
from continuum_msgs.msg import CableStates

LONGEST_TEXT = 200
"""Largest number of characters of a name or message of a status that are shown."""


def read_angles(message: JointState, known: Collection[str]) -> dict[str, float]:
    """Return the angles [rad] of the ``known`` joints of a message, by name.

    Raises:
        MessageFault: no joint is known, an array has another length, a name is repeated, or a number is not finite.
    """
    index = read_names(message)
    found = {name: message.position[i] for name, i in index.items() if name in known}
    if not found:
        raise messages.nothing_known("joint", message.name, sorted(known))
    messages.finite("position", list(found.values()))
    return found


def read_cables(message: CableStates, known: Collection[str]) -> tuple[dict[str, float], dict[str, float]]:
    """Return lengths [m] and tensions [N] by name, empty if the message has none.

    Raises:
        MessageFault: a name is not ``known`` or repeated, an array has another length, or a number is not finite.
    """
    messages.positions_by_name(message.name)
    messages.no_others(list(known), message.name)
    return _by_name(message, "position", message.position), _by_name(message, "effort", message.effort)


def read_statuses(message: DiagnosticArray) -> dict[str, Status]:
    """Return the statuses by name."""
    return {
        status.name[:LONGEST_TEXT]: Status(
            status.name[:LONGEST_TEXT], int.from_bytes(status.level, "little"), status.message[:LONGEST_TEXT]
        )
        for status in message.status
    }


def _by_name(message: CableStates, field: str, values: Array) -> dict[str, float]:
    messages.same_length(field, values, message.name, optional=True)
    if not len(values):
        return {}
    return dict(zip(message.name, messages.finite(field, values).tolist(), strict=True))

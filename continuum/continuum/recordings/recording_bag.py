"""Recordings from rosbag2: `joint_states` and `cable_states` of one section that bends in a plane.

The node `dynamics`, or a real arm in its place, publishes angles and rates of the bending joints, and the cables'
tensions as `effort`. An arm with drives at its joints has their torques as `effort` of `joint_states`; values that are
not finite, or zero throughout, mean that there are none. Messages on damage name the number of the `joint_states`
message, from 1 in the order of the stamps.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.dynamics.tensions import Tensions
from continuum.errors import FileError
from continuum.joint_names import cable_names, phi_joint, theta_joints
from continuum.languages import Message
from continuum.printable import printable
from continuum.recordings.arm_messages import of_an_arm
from continuum.recordings.arm_recording import TOPICS
from continuum.recordings.bag import Bag, stamp_ns
from continuum.recordings.named_values import named_values
from continuum.recordings.recording import Recording
from continuum.recordings.recording_checks import repaired
from continuum.recordings.samples import MESSAGE, Samples

_JOINTS, _CABLES = "/joint_states", "/cable_states"
_IN_PLANE = 1e-3  # rad, by which the bending plane may turn
_FARTHEST = 0.1  # s, from a joint state to the nearest known tension


def read_recording_bag(path: str | Path) -> Recording:
    """Read one run, named after its folder; time counts from its first joint state.

    Raises:
        FileError: not a readable recording, not of a section that bends in a plane, or damaged beyond repair.
    """
    with Bag(path) as bag:
        every = list(bag.messages(_JOINTS, TOPICS[_JOINTS]))
        if not every:
            raise FileError(bag.path, f"has no message on {_JOINTS}")
        joints, others = of_an_arm(bag.path, _JOINTS, every)
        start = stamp_ns(joints[0])
        section, names = _bending_joints(bag, joints)
        times = _seconds(joints, start)
        theta = _table(bag, joints, "position", names)
        rate = _table(bag, joints, "velocity", names) if any(len(one.velocity) for one in joints) else None
        if rate is not None and not np.any(np.isfinite(rate)):
            rate, others = (
                None,
                (*others, Message("no velocity on {topic} is a finite number: rates left out", topic=_JOINTS)),
            )
        torque = _torque(joints, names)
        pull, other_cables = _pull(bag, section, start, times)
        if pull is not None and torque is not None:
            raise FileError(
                bag.path, f"has efforts on {_JOINTS} and on {_CABLES}: an arm is driven by one or the other"
            )
    numbers = np.arange(1, len(joints) + 1)
    good, notes = repaired(Samples(bag.path, numbers, times, theta, rate, pull, MESSAGE, torque))
    tensions = None if good.pull is None else Tensions(good.times, good.pull)
    torques = None if good.torque is None else JointTorques(good.times, good.torque)
    notes = (*others, *other_cables, *notes)
    if tensions is None and torques is None:
        notes = (*notes, Message("no efforts on {topic}: cables assumed slack", topic=_CABLES))
    return Recording(
        printable(bag.path.name if bag.path.is_dir() else bag.path.stem),
        good.times,
        good.theta,
        good.rate,
        tensions,
        notes,
        torques,
    )


def _bending_joints(bag: Bag, joints: Sequence[Any]) -> tuple[str, list[str]]:
    """Return the names of the section and of its bending joints from base to tip; its plane must not turn."""
    known = list(dict.fromkeys(name for one in joints for name in one.name))
    first = theta_joints("", 1)[0]
    sections = [name.removesuffix(first) for name in known if name.endswith(first)]
    if len(sections) != 1:
        found = ", ".join(sections) or "none"
        raise FileError(bag.path, f"has the sections {found} on {_JOINTS}; one that bends in a plane is needed")
    turn = phi_joint(sections[0])
    turned = np.abs(_table(bag, joints, "position", [turn])) if turn in known else np.zeros(1)
    if not np.all(turned[np.isfinite(turned)] <= _IN_PLANE):
        raise FileError(bag.path, f"has an arm that turns its plane by {turn}; one that bends in a plane is needed")
    return sections[0], [name for name in theta_joints(sections[0], len(known)) if name in known]


def _torque(joints: Sequence[Any], names: Sequence[str]) -> Array | None:
    """Return the joints' efforts, (n_times, n_joints) [N m], NaN in a message without; None if all are zero or NaN."""
    torque = np.full((len(joints), len(names)), np.nan)
    for row, one in zip(torque, joints, strict=True):
        if len(one.effort) == len(one.name):
            by_name = dict(zip(one.name, one.effort, strict=True))
            row[:] = [by_name.get(name, np.nan) for name in names]
    known = np.all(np.isfinite(torque), axis=1)
    return torque if np.any(torque[known]) else None


def _pull(bag: Bag, section: str, start: int, times: Array) -> tuple[Array | None, tuple[str, ...]]:
    """Return tensions at the times of the joint states, (n_times, n_cables) [N], NaN far from known ones; and notes."""
    messages = bag.messages(_CABLES, TOPICS[_CABLES]) if _CABLES in bag.topics else []
    there, others = of_an_arm(bag.path, _CABLES, messages)
    if not any(len(one.effort) for one in there):
        return None, others
    known = _seconds(there, start)
    tensions = _table(bag, there, "effort", cable_names(section, len(SIDES)))
    pull = np.stack([np.interp(times, known, column) for column in tensions.T], axis=1)
    after = np.searchsorted(known, times)
    near = np.minimum(np.abs(known[np.maximum(after - 1, 0)] - times), np.abs(known.take(after, mode="clip") - times))
    pull[near > _FARTHEST] = np.nan
    if np.all(near > _FARTHEST):
        raise FileError(
            bag.path, f"has no message on {_CABLES} within {_FARTHEST} s of one on {_JOINTS}: stamps of two clocks?"
        )
    return pull, others


def _table(bag: Bag, messages: Sequence[Any], field: str, names: Sequence[str]) -> Array:
    """Return a row for each message and a column for each name; missing and non-finite values are left for repair."""
    table = np.full((len(messages), len(names)), np.nan)
    for row, one in zip(table, messages, strict=True):
        if len(given := getattr(one, field)):
            row[:] = named_values(bag, one, given, names, finite=False)
    return table


def _seconds(messages: Sequence[Any], start: int) -> Array:
    return np.array([stamp_ns(one) - start for one in messages]) * 1e-9

"""What a recording says over time, to be asked for any instant: a rosbag2 folder, or a CSV table of joint angles."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.identification.recording_csv import read_recording_csv
from continuum.joint_names import cable_names, theta_joints
from continuum.recordings.arm_recording import TOPICS
from continuum.recordings.bag import Bag, stamp_ns
from continuum.recordings.named_values import named_values

SIMULATED = "/simulated"
"""Namespace of a simulated arm beside a measured one."""

_SECTION = "section_1"
"""What the section of a table is called, which names none."""


@dataclass(frozen=True)
class Track:
    """Values of some names over time; those of an instant hold until the next.

    Attributes:
        times: rising (n,) [s].
        names: of the columns.
        values: (n, n_names).
    """

    times: Array
    names: tuple[str, ...]
    values: Array

    def at(self, time: float) -> Mapping[str, float]:
        """Values by name at an instant [s]; before the first, none."""
        row = int(np.searchsorted(self.times, time, side="right")) - 1
        return dict(zip(self.names, self.values[row].tolist(), strict=True)) if row >= 0 else {}


NOTHING = Track(np.empty(0), (), np.empty((0, 0)))


@dataclass(frozen=True)
class Tracks:
    """One recording; what it does not have is empty. Time begins with its first joint state.

    Attributes:
        joints, simulated: joint angles [rad].
        lengths: of cables [m].
        tensions: of cables [N].
        target: of the tip: x, y, z [m].
    """

    joints: Track
    simulated: Track = NOTHING
    lengths: Track = NOTHING
    tensions: Track = NOTHING
    target: Track = NOTHING

    @property
    def duration(self) -> float:
        """To the last joint state [s]."""
        return float(self.joints.times[-1])


def read_tracks(path: str | Path) -> Tracks:
    """Read a recording: a folder is one of rosbag2, a file a CSV table.

    Raises:
        FileError: it cannot be read, or has no joint angles.
    """
    return _from_bag(path) if Path(path).is_dir() else _from_table(path)


def _from_table(path: str | Path) -> Tracks:
    run = read_recording_csv(path)
    times = run.times - run.times[0]
    joints = Track(times, theta_joints(_SECTION, run.n_joints), run.theta)
    if run.tensions is None:
        return Tracks(joints)
    pull = run.tensions
    tensions = Track(pull.times - run.times[0], cable_names(_SECTION, pull.values.shape[1]), pull.values)
    return Tracks(joints, tensions=tensions)


def _from_bag(path: str | Path) -> Tracks:
    with Bag(path) as bag:
        joints = _read(bag, "/joint_states", lambda message: message.position)
        if not joints.times.size:
            raise FileError(bag.path, "has no message on /joint_states")
        start = joints.times[0]
        tracks = [
            joints,
            _read(bag, "/joint_states", lambda message: message.position, SIMULATED),
            _read(bag, "/cable_states", lambda message: message.position),
            _read(bag, "/cable_states", lambda message: message.effort),
            _read_targets(bag),
        ]
    return Tracks(*(Track(track.times - start, track.names, track.values) for track in tracks))


def _read(bag: Bag, topic: str, values_of: Callable[[Any], Sequence[float]], namespace: str = "") -> Track:
    """Of the messages that have values; all must have the names of the first."""
    if namespace + topic not in bag.topics:
        return NOTHING
    messages = [one for one in bag.messages(namespace + topic, TOPICS[topic]) if len(values_of(one))]
    if not messages:
        return NOTHING
    names = tuple(messages[0].name)
    return _sorted(messages, names, [named_values(bag, one, np.asarray(values_of(one)), names) for one in messages])


def _read_targets(bag: Bag) -> Track:
    if "/traj_pose" not in bag.topics:
        return NOTHING
    messages = list(bag.messages("/traj_pose", TOPICS["/traj_pose"]))
    points = [[getattr(one.pose.position, axis) for axis in "xyz"] for one in messages]
    return _sorted(messages, tuple("xyz"), points) if messages else NOTHING


def _sorted(messages: Sequence[Any], names: tuple[str, ...], values: Sequence[Any]) -> Track:
    times = np.array([1e-9 * stamp_ns(one) for one in messages])
    order = np.argsort(times, kind="stable")
    return Track(times[order], names, np.array(values, dtype=float)[order])

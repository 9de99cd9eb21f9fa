"""Values of a recording over time, available at any instant: of a rosbag2 folder or a CSV table of joint angles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.joint_names import bending_joints, cable_names, theta_joints
from continuum.recordings.arm_messages import of_an_arm
from continuum.recordings.arm_recording import TOPICS
from continuum.recordings.bag import Bag, is_bag, stamp_ns
from continuum.recordings.joined_sections import joined_sections
from continuum.recordings.named_values import named_values
from continuum.recordings.plausible_values import LARGEST_TURN
from continuum.recordings.recording import Recording
from continuum.recordings.recording_csv import read_recording_csv

SIMULATED = "/simulated"
"""Namespace of a simulated arm beside a measured one."""

_SECTION = "section_1"
"""Name of the section of a table, which has none."""


@dataclass(frozen=True)
class Track:
    """Named values over time, constant from each instant to the next.

    Attributes:
        times: increasing times, (n,) [s].
        names: names of the columns.
        values: values, (n, n_names).
    """

    times: Array
    names: tuple[str, ...]
    values: Array

    def at(self, time: float) -> Mapping[str, float]:
        """Return the values by name at an instant [s]; none before the first."""
        row = int(np.searchsorted(self.times, time, side="right")) - 1
        return dict(zip(self.names, self.values[row].tolist(), strict=True)) if row >= 0 else {}


NOTHING = Track(np.empty(0), (), np.empty((0, 0)))


@dataclass(frozen=True)
class Tracks:
    """One recording; missing quantities are empty. Time starts at the first joint state.

    Attributes:
        joints, simulated: joint angles [rad].
        lengths: lengths of cables [m].
        tensions: tensions of cables [N].
        target: target of the tip: x, y, z [m].
        origin: time at which the tracks begin, as `read_recording` counts it [s].
        notes: data omitted or repaired while reading, one sentence each.
    """

    joints: Track
    simulated: Track = NOTHING
    lengths: Track = NOTHING
    tensions: Track = NOTHING
    target: Track = NOTHING
    origin: float = 0.0
    notes: tuple[str, ...] = ()

    @property
    def duration(self) -> float:
        """Time of the last joint state [s]."""
        return float(self.joints.times[-1])


def read_tracks(path: str | Path) -> Tracks:
    """Read a recording: a folder or storage file of rosbag2; any other file is a CSV table.

    Raises:
        FileError: the recording cannot be read or has no joint angles.
    """
    return _from_bag(path) if is_bag(path) else tracks_of(read_recording_csv(path))


def tracks_of(run: Recording) -> Tracks:
    """Return a run as tracks of one section."""
    origin = float(run.times[0])
    times = run.times - origin
    joints = Track(times, theta_joints(_SECTION, run.n_joints), run.theta)
    if run.tensions is None:
        return Tracks(joints, origin=origin, notes=run.notes)
    pull = run.tensions
    tensions = Track(pull.times - origin, cable_names(_SECTION, pull.values.shape[1]), pull.values)
    return Tracks(joints, tensions=tensions, origin=origin, notes=run.notes)


def _from_bag(path: str | Path) -> Tracks:
    notes: list[str] = []
    with Bag(path) as bag:
        if "/joint_states" not in bag.topics:
            raise FileError(bag.path, f"has no topic /joint_states; it has {bag.topics_in_words()}")
        (joints,) = _read(bag, "/joint_states", ("position",), notes)
        if not joints.times.size:
            raise FileError(bag.path, "has no message on /joint_states")
        _refuse_degrees(bag, joints)
        start = joints.times[0]
        tracks = [
            joints,
            *_read(bag, "/joint_states", ("position",), notes, SIMULATED),
            *_read(bag, "/cable_states", ("position", "effort"), notes),
            _read_targets(bag),
        ]
    joints, simulated, lengths, tensions, target = (Track(t.times - start, t.names, t.values) for t in tracks)
    return Tracks(joints, simulated, lengths, tensions, target, notes=tuple(notes))


def _refuse_degrees(bag: Bag, joints: Track) -> None:
    for name, angle in zip(joints.names, np.abs(joints.values).max(axis=0), strict=True):
        if bending_joints([name]) and angle > LARGEST_TURN:
            raise FileError(bag.path, f"has a joint angle of {angle:.3g} rad for {name}: degrees taken for radians?")


def _read(bag: Bag, topic: str, fields: Sequence[str], notes: list[str], namespace: str = "") -> list[Track]:
    """Return a track of each field from the messages that have it; all need the names of the first such message.

    Omitted messages are added to ``notes``.
    """
    if namespace + topic not in bag.topics:
        return [NOTHING] * len(fields)
    names: dict[str, tuple[str, ...]] = {}
    times: dict[str, list[float]] = {field: [] for field in fields}
    rows: dict[str, list[Array]] = {field: [] for field in fields}
    messages = list(bag.messages(namespace + topic, TOPICS[topic]))
    if topic == "/joint_states":
        messages, alone = joined_sections(bag.path, namespace + topic, messages)
        notes += alone
    mine, others = of_an_arm(bag.path, namespace + topic, messages)
    notes += others
    for one in mine:
        for field in fields:
            values = np.asarray(getattr(one, field))
            if len(values):
                wanted = names.setdefault(field, tuple(one.name))
                times[field].append(1e-9 * stamp_ns(one))
                rows[field].append(named_values(bag, one, values, wanted))
    return [_sorted(times[field], names[field], rows[field]) if field in names else NOTHING for field in fields]


def _read_targets(bag: Bag) -> Track:
    if "/traj_pose" not in bag.topics:
        return NOTHING
    times, points = [], []
    for one in bag.messages("/traj_pose", TOPICS["/traj_pose"]):
        times.append(1e-9 * stamp_ns(one))
        points.append([getattr(one.pose.position, axis) for axis in "xyz"])
    if not np.isfinite(points).all():
        raise FileError(bag.path, "has a message on /traj_pose whose position is not finite")
    return _sorted(times, tuple("xyz"), points) if points else NOTHING


def _sorted(times: Sequence[float], names: tuple[str, ...], values: Sequence[Any]) -> Track:
    order = np.argsort(times, kind="stable")
    return Track(np.array(times)[order], names, np.array(values, dtype=float)[order])

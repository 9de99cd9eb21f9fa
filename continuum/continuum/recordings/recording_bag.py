"""Recordings from rosbag2: `joint_states` and `cable_states` of an arm that bends in a plane.

The node `dynamics`, or a real arm in its place, publishes angles and rates of the bending joints of a section, and the
cables' tensions as `effort`. An arm with drives at its joints has their torques as `effort` of `joint_states`; values
that are not finite, or zero throughout, mean that there are none. Joints may have any names, on any topic, if the model
or the caller names them; what the model says of their signs and zeros turns their readings into the model's angles.
Messages on damage name the number of the `joint_states` message, from 1 in the order of the stamps.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.model import InputKind, Model, NamedJoint
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


@dataclass(frozen=True)
class _Joints:
    """Joints of a recording.

    Attributes:
        named: the joints from base to tip.
        section: section of the workspace's names; None if the joints have other names.
    """

    named: tuple[NamedJoint, ...]
    section: str | None

    @property
    def names(self) -> list[str]:
        """Names from base to tip."""
        return [one.name for one in self.named]

    @property
    def signs(self) -> Array:
        """1 or -1, (n_joints,)."""
        return np.array([one.sign for one in self.named])

    @property
    def zeros(self) -> Array:
        """Angles of the model where readings are 0, (n_joints,) [rad]."""
        return np.array([one.zero for one in self.named])


def read_recording_bag(
    path: str | Path, model: Model | None = None, joints: Sequence[str] = (), topic: str | None = None
) -> Recording:
    """Read one run, named after its folder; time counts from its first joint state.

    Args:
        path: folder, or a file in it.
        model: model of the arm; if it names its joints, these are read where the recording has them.
        joints: names of the joints from base to tip, instead of the model's.
        topic: topic of the joints; tensions of cables are then read in its namespace.

    Raises:
        FileError: not a readable recording, not of such joints or of a section that bends in a plane, or damaged beyond
            repair.
    """
    with Bag(path) as bag:
        topic = f"/{(topic or _JOINTS).strip('/')}"
        every = _joint_states(bag, topic)
        arm = _arm(bag, topic, every, model, joints)
        states, others = of_an_arm(bag.path, topic, every, () if arm.section else arm.names)
        start = stamp_ns(states[0])
        if arm.section is not None:
            _refuse_turned_plane(bag, states, phi_joint(arm.section))
        times = _seconds(states, start)
        theta = _table(bag, states, "position", arm.names) * arm.signs + arm.zeros
        rate = _table(bag, states, "velocity", arm.names) * arm.signs if any(len(m.velocity) for m in states) else None
        if rate is not None and not np.any(np.isfinite(rate)):
            rate, others = (
                None,
                (*others, Message("no velocity on {topic} is a finite number: rates left out", topic=topic)),
            )
        torque = _torque(states, arm)
        driven_at_joints = model is not None and model.inputs is InputKind.JOINT_TORQUES
        cables = f"{topic.rpartition('/')[0]}{_CABLES}"
        pull, other_cables = (
            (None, ()) if driven_at_joints and not arm.section else _pull(bag, cables, arm, start, times)
        )
        if pull is not None and torque is not None:
            raise FileError(bag.path, f"has efforts on {topic} and on {cables}: an arm is driven by one or the other")
    numbers = np.arange(1, len(states) + 1)
    turns = torque is not None or driven_at_joints
    good, notes = repaired(Samples(bag.path, numbers, times, theta, rate, pull, MESSAGE, torque, turns))
    tensions = None if good.pull is None else Tensions(good.times, good.pull)
    torques = None if good.torque is None else JointTorques(good.times, good.torque)
    notes = (*_relations(arm), *others, *other_cables, *notes)
    if tensions is None and torques is None:
        slack = Message("no efforts on {topic}: cables assumed slack", topic=cables)
        notes = (*notes, Message("no efforts on {topic}: no torques", topic=topic) if driven_at_joints else slack)
    return Recording(
        printable(bag.path.name if bag.path.is_dir() else bag.path.stem),
        good.times,
        good.theta,
        good.rate,
        tensions,
        notes,
        torques,
    )


def _joint_states(bag: Bag, topic: str) -> list[Any]:
    """Return the messages of a topic of joint states; a topic that is missing or empty is refused with those there."""
    kind, types = TOPICS[_JOINTS], bag.types
    others = [other for other in types if types[other] == kind and other != topic]
    hint = f"; --topic {others[0]} reads the joint states of that topic" if others else ""
    if types.get(topic) != kind:
        problem = f"has {types[topic]} on {topic}, not {kind}" if topic in types else f"has no topic {topic}"
        raise FileError(bag.path, f"{problem}; it has {bag.topics_in_words()}{hint}")
    every = list(bag.messages(topic, kind))
    if not every:
        raise FileError(bag.path, f"has no message on {topic}; it has {bag.topics_in_words()}{hint}")
    return every


def _arm(bag: Bag, topic: str, every: Sequence[Any], model: Model | None, given: Sequence[str]) -> _Joints:
    """Return the joints to read: those that are given, those that the model names, or those of the only section."""
    found = list(dict.fromkeys(name for one in every for name in one.name))
    known = () if model is None else model.joints
    if given:
        relations = known or tuple(map(NamedJoint, given))
        wanted = tuple(replace(one, name=name) for one, name in zip(relations, given, strict=True))
    else:
        wanted = known
    if wanted and all(one.name in found for one in wanted):
        return _Joints(wanted, None)
    first = theta_joints("", 1)[0]
    sections = [name.removesuffix(first) for name in found if name.endswith(first)]
    if len(sections) == 1 and not given and not any(one.name in found for one in wanted):
        names = [name for name in theta_joints(sections[0], len(found)) if name in found]
        return _Joints(tuple(map(NamedJoint, names)), sections[0])
    there = f"has the joints {', '.join(found) or 'none'} on {topic}"
    if wanted:
        missing = [one.name for one in wanted if one.name not in found]
        by = "--joints names" if given else "the model file names"
        asked = ", ".join(one.name for one in wanted)
        raise FileError(bag.path, f"{there}, and not {', '.join(missing)}; {by} {asked}{_remedy(found, model)}")
    if sections:
        there = f"{there}, of the sections {', '.join(sections)}"
    of_one = "of one section that bends in a plane"
    wanted_names = f"those {of_one}" if sections else f"SECTION{first} and the next {of_one}"
    by_name = "or names from base to tip, by --joints or by `joints:` in the model file"
    raise FileError(bag.path, f"{there}; wanted: {wanted_names}, {by_name}{_remedy(found, model)}")


def _remedy(found: Sequence[str], model: Model | None) -> str:
    """Return the option that names the joints that were found, if they may be the model's."""
    if not found or (model is not None and model.n_joints != len(found)):
        return "" if model is None else f"; the model has {model.n_joints} joints"
    return f"; if this is their order: --joints {','.join(found)}"


def _relations(arm: _Joints) -> tuple[Message, ...]:
    """Return a note on readings that are not the model's angles."""
    turned = [one.in_words(number) for number, one in enumerate(arm.named, 1) if (one.sign, one.zero) != (1, 0)]
    if not turned:
        return ()
    return (Message("angles of the model from these readings: {relations}", relations=", ".join(turned)),)


def _refuse_turned_plane(bag: Bag, joints: Sequence[Any], turn: str) -> None:
    known = any(turn in one.name for one in joints)
    turned = np.abs(_table(bag, joints, "position", [turn])) if known else np.zeros(1)
    if not np.all(turned[np.isfinite(turned)] <= _IN_PLANE):
        raise FileError(bag.path, f"has an arm that turns its plane by {turn}; one that bends in a plane is needed")


def _torque(joints: Sequence[Any], arm: _Joints) -> Array | None:
    """Return the joints' efforts, (n_times, n_joints) [N m], NaN in a message without; None if all are zero or NaN."""
    torque = np.full((len(joints), len(arm.named)), np.nan)
    for row, one in zip(torque, joints, strict=True):
        if len(one.effort) == len(one.name):
            by_name = dict(zip(one.name, one.effort, strict=True))
            row[:] = [by_name.get(name, np.nan) for name in arm.names]
    known = np.all(np.isfinite(torque), axis=1)
    return torque * arm.signs if np.any(torque[known]) else None


def _pull(
    bag: Bag, topic: str, arm: _Joints, start: int, times: Array
) -> tuple[Array | None, tuple[Message | str, ...]]:
    """Return tensions at the times of the joint states, (n_times, n_cables) [N], NaN far from known ones; and notes."""
    messages = bag.messages(topic, TOPICS[_CABLES]) if topic in bag.topics else []
    there, others = of_an_arm(bag.path, topic, messages)
    if not any(len(one.effort) for one in there):
        return None, others
    section = arm.section or _section_of_cables(bag, topic, there)
    known = _seconds(there, start)
    tensions = _table(bag, there, "effort", cable_names(section, len(SIDES)))
    pull = np.stack([np.interp(times, known, column) for column in tensions.T], axis=1)
    after = np.searchsorted(known, times)
    near = np.minimum(np.abs(known[np.maximum(after - 1, 0)] - times), np.abs(known.take(after, mode="clip") - times))
    pull[near > _FARTHEST] = np.nan
    if np.all(near > _FARTHEST):
        raise FileError(
            bag.path, f"has no message on {topic} within {_FARTHEST} s of one with joints: stamps of two clocks?"
        )
    return pull, others


def _section_of_cables(bag: Bag, topic: str, messages: Sequence[Any]) -> str:
    """Return the section whose cables drive joints with names of their own."""
    first = cable_names("", 1)[0]
    found = list(dict.fromkeys(name for one in messages for name in one.name))
    sections = [name.removesuffix(first) for name in found if name.endswith(first)]
    if len(sections) != 1:
        wanted = f"NAME{first} and the next of one section"
        raise FileError(bag.path, f"has the cables {', '.join(found)} on {topic}; wanted: {wanted}")
    return str(sections[0])


def _table(bag: Bag, messages: Sequence[Any], field: str, names: Sequence[str]) -> Array:
    """Return a row for each message and a column for each name; missing and non-finite values are left for repair."""
    table = np.full((len(messages), len(names)), np.nan)
    for row, one in zip(table, messages, strict=True):
        if len(given := getattr(one, field)):
            row[:] = named_values(bag, one, given, names, finite=False)
    return table


def _seconds(messages: Sequence[Any], start: int) -> Array:
    return np.array([stamp_ns(one) - start for one in messages]) * 1e-9

"""The streams of an arm in a recording, as arrays: trajectory, joints and cables by stamp."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.configuration import allen_from_jones
from continuum.recordings.bag import Bag, stamp_ns
from continuum.recordings.named_values import named_values
from continuum.recordings.recorded_arm import check_joints

Stamps = NDArray[np.int64]

TOPICS = {
    "/traj_pose": "geometry_msgs/msg/PoseStamped",
    "/ik_status": "continuum_msgs/msg/IkStatus",
    "/joint_states": "sensor_msgs/msg/JointState",
    "/cable_states": "continuum_msgs/msg/CableStates",
}
"""Topics with one message for every pose, and their types; these messages are read."""

SECTION_TOPICS = {"/section_cable_states": "continuum_msgs/msg/CableStates"}
"""Topics with one message of every section for every pose; these messages are counted."""

OPTIONAL_TOPICS = {"/traj_twist": "geometry_msgs/msg/TwistStamped"}
OPTIONAL_SECTION_TOPICS = {"/section_config_states": "continuum_msgs/msg/ConfigStates"}
"""The same, counted if recorded."""


@dataclass(frozen=True)
class Stream:
    """One topic, by stamp.

    Attributes:
        stamps: unique stamps in rising order, (n,) [ns], regardless of the order and number of messages.
        values: values of the first message of each stamp, (n, ...).
    """

    stamps: Stamps
    values: Array

    def at(self, stamps: Stamps) -> Array:
        """Return the values at the given stamps (m,) [ns]; NaN where a stamp is not in the stream."""
        rows = np.full((len(stamps), *self.values.shape[1:]), np.nan)
        _, wanted, found = np.intersect1d(stamps, self.stamps, return_indices=True)
        rows[wanted] = self.values[found]
        return rows


@dataclass(frozen=True)
class ArmRecording:
    """The recorded streams of a kinematic run.

    Attributes:
        targets: target positions of the tip (n, 3) [m].
        status: answers of the inverse kinematics (n, 2): status number and distance [m].
        configurations: Allen coordinates from the joint states (n, n_sections, 2) [rad].
        lengths: total cable lengths (n, n_cables) [m], in the order of ``arm.cable_names``.
        rates: rates of these lengths (n, n_cables) [m/s]; NaN where a message has none.
        arrivals: stamps (m,) [ns] of all messages in the order of their arrival, by topic; a topic that all sections
            share has one entry for every section.
    """

    arm: Arm
    targets: Stream
    status: Stream
    configurations: Stream
    lengths: Stream
    rates: Stream
    arrivals: dict[str, Stamps]


def read_arm_recording(bag: Bag, arm: Arm) -> ArmRecording:
    """Read the streams of ``arm`` from a recording.

    Raises:
        FileError: a topic is missing, or a message has other joints or cables than the arm or lacks a finite value.
    """
    messages = {topic: list(bag.messages(topic, message_type)) for topic, message_type in TOPICS.items()}
    n_cables = len(arm.cable_names)
    for names in {tuple(message.name) for message in messages["/joint_states"]}:
        check_joints(bag.path, names, arm)

    def stream(topic: str, shape: tuple[int, ...], value_of: Callable[[Any], ArrayLike]) -> Stream:
        stamps, first = np.unique(_stamps(messages[topic]), return_index=True)
        values = [value_of(messages[topic][i]) for i in first]
        return Stream(stamps, np.array(values, dtype=float).reshape(len(stamps), *shape))

    def lengths_of(message: Any) -> Array:
        return named_values(bag, message, message.position, arm.cable_names)

    def rates_of(message: Any) -> Array:
        if len(message.velocity) == 0:
            return np.full(n_cables, np.nan)
        return named_values(bag, message, message.velocity, arm.cable_names)

    return ArmRecording(
        arm=arm,
        targets=stream("/traj_pose", (3,), lambda m: _xyz(m.pose.position)),
        status=stream("/ik_status", (2,), lambda m: [float(m.status), m.distance]),
        configurations=stream("/joint_states", (arm.n_sections, 2), lambda m: _configuration(bag, m, arm)),
        lengths=stream("/cable_states", (n_cables,), lengths_of),
        rates=stream("/cable_states", (n_cables,), rates_of),
        arrivals={topic: _stamps(messages[topic]) for topic in TOPICS} | _other_arrivals(bag, arm),
    )


def _other_arrivals(bag: Bag, arm: Arm) -> dict[str, Stamps]:
    """Return the stamps of the streams whose values are not needed."""
    there = bag.topics
    arrivals = {
        topic: _stamps(list(bag.messages(topic, message_type)))
        for topic, message_type in OPTIONAL_TOPICS.items()
        if topic in there
    }
    optional = {topic: message_type for topic, message_type in OPTIONAL_SECTION_TOPICS.items() if topic in there}
    for topic, message_type in (SECTION_TOPICS | optional).items():
        messages = list(bag.messages(topic, message_type))
        for number in range(1, arm.n_sections + 1):
            own = [message for message in messages if message.section == number]
            arrivals[f"{topic} of section {number}"] = _stamps(own)
    return arrivals


def _stamps(messages: list[Any]) -> Stamps:
    return np.array([stamp_ns(message) for message in messages], dtype=np.int64)


def _configuration(bag: Bag, message: Any, arm: Arm) -> Array:
    """Return the Allen coordinates (n_sections, 2) of a joint state message; theta sums over a section's joints."""
    names = [name for section in arm.sections for name in (section.phi_joint, *section.theta_joints)]
    angles = dict(zip(names, named_values(bag, message, message.position, names), strict=True))
    return np.array(
        [
            allen_from_jones(angles[section.phi_joint], sum(angles[name] for name in section.theta_joints))
            for section in arm.sections
        ]
    )


def _xyz(vector: Any) -> list[float]:
    return [vector.x, vector.y, vector.z]

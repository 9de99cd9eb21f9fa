"""Recordings whose truth is known: an arm that sways, as the nodes of the workspace would have recorded it."""

import itertools
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from continuum_laws.samples import arm_of
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from continuum.arm import Arm, arm_to_mapping
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import jones_from_allen
from continuum.kinematics.routing import section_lengths, tangle, tangle_rates
from continuum.recordings.arm_recording import ArmRecording, read_arm_recording
from continuum.recordings.bag import Bag

MESSAGES = Path(__file__).parents[2] / "continuum_msgs" / "msg"

ARM = arm_of(2, twist=0.4)
N = 60
RATE = 100.0
"""Poses per second [Hz]."""
START = 1_700_000_000_123_456_789
"""Stamp of the first pose [ns]."""

STAMPS = START + np.round(np.arange(N) * 1e9 / RATE).astype(np.int64)

TYPES = {
    "/traj_pose": "geometry_msgs/msg/PoseStamped",
    "/traj_twist": "geometry_msgs/msg/TwistStamped",
    "/joint_states": "sensor_msgs/msg/JointState",
    "/ik_status": "continuum_msgs/msg/IkStatus",
    "/section_config_states": "continuum_msgs/msg/ConfigStates",
    "/section_cable_states": "continuum_msgs/msg/CableStates",
    "/cable_states": "continuum_msgs/msg/CableStates",
}

type Topics = dict[str, list[Any]]
"""Messages by topic, in the order of their arrival."""


@cache
def typestore() -> Typestore:
    """ROS's types and those of the workspace."""
    store = get_typestore(Stores.ROS2_JAZZY)
    for path in MESSAGES.glob("*.msg"):
        store.register(get_types_from_msg(path.read_text(encoding="utf-8"), f"continuum_msgs/msg/{path.stem}"))
    return store


def postures() -> tuple[np.ndarray, np.ndarray]:
    """Configurations (N, 2, 2) [rad] and their rates [rad/s]: every coordinate sways, and begins and ends in motion."""
    t = np.arange(N)[:, None, None] / RATE
    amplitude, phase = np.array([[0.5, 0.3], [0.2, 0.6]]), np.array([[0.1, 1.0], [2.0, 3.0]])
    speed = np.array([[1.0, 1.4], [0.7, 1.1]])
    return amplitude * np.sin(speed * t + phase) + 0.2, amplitude * speed * np.cos(speed * t + phase)


def tips() -> np.ndarray:
    """Where the tip was (N, 3) [m]."""
    return arm_pose(postures()[0], ARM)[:, :3, 3]


def message(message_type: str, stamp: int, **fields: object) -> Any:
    """A message with a header; fields that are not given are 0 or empty."""
    made = _made(message_type, fields)
    made.header.stamp.sec, made.header.stamp.nanosec = divmod(int(stamp), 1_000_000_000)
    return made


def _made(message_type: str, fields: Mapping[str, object]) -> Any:
    store = typestore()
    empty = {"string": "", "float64": 0.0, "uint32": 0, "int32": 0, "uint8": 0}
    values = {}
    for name, (kind, detail) in store.fielddefs[message_type][1]:
        if name in fields:
            values[name] = fields[name]
        elif kind.name == "NAME":
            values[name] = _made(detail, {})
        elif kind.name == "SEQUENCE":
            values[name] = [] if detail[0][1][0] == "string" else np.zeros(0)
        else:
            values[name] = empty[detail[0]]
    return store.types[message_type](**values)


def point(values: np.ndarray) -> Any:
    """A pose [m] without rotation."""
    return _made(
        "geometry_msgs/msg/Pose", {"position": typestore().types["geometry_msgs/msg/Point"](*map(float, values))}
    )


def joint_state(stamp: int, w: np.ndarray) -> Any:
    """Joints of a posture (2, 2) [rad], the last one of the arm first."""
    phi, theta = jones_from_allen(w)
    angles = {}
    for i, section in enumerate(ARM.sections):
        angles |= {section.phi_joint: phi[i], section.phi_back_joint: -phi[i]}
        angles |= dict.fromkeys(section.theta_joints, theta[i] / section.n_joints)
    names = list(reversed(angles))
    return message(TYPES["/joint_states"], stamp, name=names, position=np.array([angles[name] for name in names]))


def run(target_offsets: np.ndarray | float = 0.0, rate_factor: float = 1.0) -> Topics:
    """A run without a fault.

    Args:
        target_offsets: what lies between tip and target (N, 3) [m].
        rate_factor: what the cables' true rates are multiplied by.
    """
    w, w_rate = postures()
    targets, lengths = tips() + target_offsets, tangle(w, ARM)
    rates = rate_factor * tangle_rates(w, w_rate, ARM)
    names = list(ARM.cable_names)
    topics: Topics = {topic: [] for topic in TYPES}
    for i, stamp in enumerate(STAMPS):
        topics["/traj_pose"].append(message(TYPES["/traj_pose"], stamp, pose=point(targets[i])))
        topics["/traj_twist"].append(message(TYPES["/traj_twist"], stamp))
        topics["/joint_states"].append(joint_state(stamp, w[i]))
        topics["/ik_status"].append(message(TYPES["/ik_status"], stamp))
        topics["/cable_states"].append(
            message(TYPES["/cable_states"], stamp, name=names, position=lengths[i], velocity=rates[i])
        )
        for k, section in enumerate(ARM.sections):
            within = section_lengths(w[i, k], ARM, k)[: len(section.cable_names)]
            cables = {"name": list(section.cable_names), "position": within}
            topics["/section_config_states"].append(message(TYPES["/section_config_states"], stamp, section=k + 1))
            topics["/section_cable_states"].append(
                message(TYPES["/section_cable_states"], stamp, section=k + 1, **cables)
            )
    return topics


def write(path: Path, topics: Topics, storage: StoragePlugin = StoragePlugin.MCAP) -> Path:
    """Write a recording to the folder ``path``; arrival times count up over all topics in turn."""
    store = typestore()
    with Writer(path, version=9, storage_plugin=storage) as writer:
        places = {topic: writer.add_connection(topic, TYPES[topic], typestore=store) for topic in topics}
        arrival = itertools.count(START + 1_000_000, 10_000)
        for topic, messages in topics.items():
            for one in messages:
                writer.write(places[topic], next(arrival), store.serialize_cdr(one, TYPES[topic]))
    return path


def read(folder: Path, arm: Arm = ARM) -> ArmRecording:
    """Read the recording in ``folder`` as one of ``arm``."""
    with Bag(folder) as bag:
        return read_arm_recording(bag, arm)


def arm_file(path: Path) -> Path:
    """Write the parameter file of the arm to ``path``."""
    path.write_text(yaml.safe_dump({"/**": {"ros__parameters": {"arm": arm_to_mapping(ARM)}}}), encoding="utf-8")
    return path

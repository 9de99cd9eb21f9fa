"""Messages of a continuously moving arm at one rate: joints, cables with tensions, and targets of the tip."""

from __future__ import annotations

import time

import numpy as np
from geometry_msgs.msg import PoseStamped
from harness import Probe
from rclpy.time import Time
from sensor_msgs.msg import JointState

from continuum.arm import Arm
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.routing import tangle
from continuum_manipulator.arm_joints import arm_joint_names, arm_joint_values
from continuum_manipulator.nodekit.qos import STREAM
from continuum_manipulator.nodekit.stamps import nanoseconds
from continuum_msgs.msg import CableStates

RATE = 120.0
"""Messages per second on each topic [Hz]."""

_POSTURES = 240


class MovingArm:
    """Publishes messages, and measures the latency of a section's answers to joint states.

    Args:
        arm: the arm.
        domain: ROS domain.
    """

    def __init__(self, arm: Arm, domain: int) -> None:
        self.probe = Probe(domain, "moving_arm")
        node = self.probe.node
        self._publish_joints = node.create_publisher(JointState, "joint_states", STREAM).publish
        self._publish_cables = node.create_publisher(CableStates, "cable_states", STREAM).publish
        self._publish_target = node.create_publisher(PoseStamped, "traj_pose", STREAM).publish
        node.create_subscription(CableStates, "section_cable_states", self._on_answer, STREAM)
        self._sent: dict[int, float] = {}
        self.latencies: list[float] = []
        self._messages = [_messages(w, arm) for w in _way(arm.n_sections)]
        self._number = 0

    def run(self, duration: float) -> None:
        """Move for a ``duration`` [s]."""
        begin = time.monotonic()
        for k in range(int(duration * RATE)):
            due = begin + k / RATE
            while (left := due - time.monotonic()) > 0.0:
                self.probe.spin(left)
            self._step()

    def _step(self) -> None:
        joints, cables, target = self._messages[self._number % _POSTURES]
        self._number += 1
        stamp = Time(nanoseconds=time.time_ns()).to_msg()
        for message in (joints, cables, target):
            message.header.stamp = stamp
        self._sent[nanoseconds(stamp)] = time.monotonic()
        self._publish_joints(joints)
        self._publish_cables(cables)
        self._publish_target(target)

    def _on_answer(self, message: CableStates) -> None:
        sent = self._sent.get(nanoseconds(message.header.stamp))
        if sent is not None:
            self.latencies.append(time.monotonic() - sent)


def _way(n_sections: int) -> list[np.ndarray]:
    """Return postures (n_sections, 2) [rad] on a closed loop."""
    turns = 2 * np.pi * np.arange(_POSTURES) / _POSTURES
    sections = np.arange(n_sections)
    return [0.4 * np.stack([np.sin(turn + sections), np.cos(2 * turn + sections)], axis=1) for turn in turns]


def _messages(w: np.ndarray, arm: Arm) -> tuple[JointState, CableStates, PoseStamped]:
    lengths = tangle(w, arm)
    target = PoseStamped()
    target.header.frame_id = "base_link"
    target.pose.position.x, target.pose.position.y, target.pose.position.z = arm_pose(w, arm)[:3, 3].tolist()
    return (
        JointState(name=list(arm_joint_names(arm)), position=arm_joint_values(w, None, arm)[0]),
        CableStates(name=list(arm.cable_names), position=lengths, effort=5.0 + 10.0 * np.abs(lengths)),
        target,
    )

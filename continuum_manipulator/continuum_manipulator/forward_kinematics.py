"""Node of forward kinematics: description, frames of all links, pose and twist of the tip from the joints."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from geometry_msgs.msg import PoseStamped, TwistStamped
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from continuum.arrays import Array
from continuum.kinematics.joint_chain import joint_chain, tip_pose, tip_twist
from continuum.parameter_spec import ParameterSpec
from continuum.urdf.robot import urdf_text
from continuum_manipulator.arm_joints import arm_joint_names
from continuum_manipulator.link_transforms import LinkTransforms
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.qos import LATCHED, TRANSFORMS
from continuum_manipulator.nodekit.stamps import NANOSECONDS, StampJoiner, nanoseconds
from continuum_manipulator.section_joints import read_bend_rates, read_bends, read_names
from continuum_manipulator.tip_targets import BASE_FRAME

SLACK = 0.1
"""Share of the period by which transforms may come early: stamps jitter, and rounded to the nanosecond, every fourth of
a stream at four times the rate would else be too early."""


class _Joints(NamedTuple):
    """Bends (n_joints, 2) [rad] of a section's joints, and their rates [rad/s] if known."""

    bends: Array
    rates: Array | None


class ForwardKinematicsNode(CheckedNode):
    """Converts ``joint_states`` to ``/tf``, ``tip_pose`` and ``tip_twist`` (Eqs. 10 and 11), in ``base_link``.

    The joints of a section may bend differently. Sections may arrive in one message or in several, which are joined by
    their stamps. Pose and twist are computed while somebody subscribes; without velocities of all joints there is no
    twist. Like robot_state_publisher, the node has the arm's URDF as its parameter ``robot_description``, publishes it
    on ``robot_description``, its fixed joints on ``/tf_static``, and its turning joints on ``/tf``.
    """

    NAME = "forward_kinematics"
    PARAMETERS = (
        ParameterSpec("robot_description", str, "URDF of the arm; empty: made of the arm", default=""),
        ParameterSpec(
            "publish_tf", bool, "publish description and frames; false where robot_state_publisher does", default=True
        ),
        ParameterSpec("publish_tip", bool, "publish pose and twist of the tip", default=True),
        ParameterSpec(
            "publish_frequency", float, "most transforms of a joint per second", "Hz", 0.0, 1e4, lower_open=True,
            default=20.0,
        ),
        ParameterSpec("frame_prefix", str, "prefix of the name of every frame on /tf", default=""),
    )  # fmt: skip
    HAS_ARM = True

    def __init__(self) -> None:
        super().__init__()
        self._chain = joint_chain(self.arm)
        self._instants: StampJoiner[int, _Joints] = StampJoiner(range(self.arm.n_sections))
        self.diagnostics.values |= {
            "instants waiting for a section": lambda: self._instants.waiting,
            "instants given up with a section missing": lambda: self._instants.incomplete + self._instants.late,
        }
        self._interval = (1.0 - SLACK) * NANOSECONDS / self.values["publish_frequency"]
        self._shown: dict[tuple[str, ...], int] = {}
        if self.values["publish_tip"]:
            self._publish_pose = self.offer(PoseStamped, "tip_pose")
            self._publish_twist = self.offer(TwistStamped, "tip_twist")
        self._links = LinkTransforms(self.values["robot_description"], self.values["frame_prefix"])
        if self.values["publish_tf"]:
            self._publish_frames = self.offer(TFMessage, "/tf", TRANSFORMS)
            self.offer(TFMessage, "/tf_static", LATCHED)(self._links.fixed)
            self.offer(String, "robot_description", LATCHED)(String(data=self.values["robot_description"]))
        self.listen(JointState, "joint_states", self._on_joints)

    def completed(self, given: Mapping[str, object]) -> Mapping[str, object]:
        """Return the given parameters, with the description of the arm if none is given."""
        return given if given.get("robot_description") else {**given, "robot_description": urdf_text(self.arm)}

    def _on_joints(self, message: JointState) -> None:
        messages.stamped(message.header.stamp)
        stamp = nanoseconds(message.header.stamp)
        names = tuple(message.name)
        is_due = self.values["publish_tf"] and self._is_due(names, stamp)
        if not is_due and not self.values["publish_tip"]:
            return
        index, found = read_names(message), dict[int, _Joints]()
        for i, section in enumerate(self.arm.sections):
            bends = read_bends(index, message.position, section)
            if bends is not None:
                rates = (
                    read_bend_rates(index, message.position, message.velocity, section) if message.velocity else None
                )
                found[i] = _Joints(bends, rates)
        if not found:
            raise messages.nothing_known("joint", message.name, arm_joint_names(self.arm))
        if is_due:
            angles = {name: message.position[i] for name, i in index.items() if math.isfinite(message.position[i])}
            self._publish_frames(self._links.moved(angles, message.header.stamp))
            self._shown[names] = stamp
        if not self.values["publish_tip"]:
            return
        for i, joints in found.items():
            instant = self._instants.add(i, stamp, joints)
            if instant is not None and (self._publish_pose.subscribers or self._publish_twist.subscribers):
                self._answer([instant[k] for k in range(self.arm.n_sections)], message)

    def _is_due(self, joints: tuple[str, ...], stamp: int) -> bool:
        """Return whether the frames of these joints are to be published at a stamp [ns], which may also go back."""
        last = self._shown.get(joints)
        return last is None or not 0 <= stamp - last < self._interval

    def _answer(self, sections: list[_Joints], message: JointState) -> None:
        bends, rates = [one.bends for one in sections], [one.rates for one in sections if one.rates is not None]
        found, pose = tip_pose(bends, self._chain), PoseStamped()
        pose.header.stamp, pose.header.frame_id = message.header.stamp, BASE_FRAME
        place, turn = pose.pose.position, pose.pose.orientation
        place.x, place.y, place.z = map(float, found[:3, 3])
        turn.x, turn.y, turn.z, turn.w = map(float, Rotation.from_matrix(found[:3, :3]).as_quat(canonical=True))
        self._publish_pose(pose)
        if len(rates) == len(bends):
            velocity, twist = tip_twist(bends, rates, self._chain), TwistStamped()
            twist.header = pose.header
            linear, angular = twist.twist.linear, twist.twist.angular
            linear.x, linear.y, linear.z = map(float, velocity[:3])
            angular.x, angular.y, angular.z = map(float, velocity[3:])
            self._publish_twist(twist)

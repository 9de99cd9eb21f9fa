"""Node of forward kinematics: pose and twist of the tip from the joints."""

from __future__ import annotations

from typing import NamedTuple

from geometry_msgs.msg import PoseStamped, TwistStamped
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

from continuum.arrays import Array
from continuum.kinematics.joint_chain import joint_chain, tip_pose, tip_twist
from continuum.parameter_spec import ParameterSpec
from continuum_manipulator.disc_transforms import disc_transforms
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.faults import MessageFault
from continuum_manipulator.nodekit.qos import TRANSFORMS
from continuum_manipulator.nodekit.stamps import StampJoiner, nanoseconds
from continuum_manipulator.section_joints import read_bend_rates, read_bends, read_names
from continuum_manipulator.tip_targets import BASE_FRAME


class _Joints(NamedTuple):
    """Bends (n_joints, 2) [rad] of a section's joints, and their rates [rad/s] if known."""

    bends: Array
    rates: Array | None


class ForwardKinematicsNode(CheckedNode):
    """Converts ``joint_states`` to ``tip_pose``, ``tip_twist`` and ``/tf`` (Eqs. 10 and 11), in ``base_link``.

    The joints of a section may bend differently. Sections may arrive in one message or in several, which are joined by
    their stamps. Without velocities of all joints there is no twist. ``/tf`` contains the base, every disc and the tip
    of each section.
    """

    NAME = "forward_kinematics"
    PARAMETERS = (
        ParameterSpec(
            "publish_tf", bool, "publish the frames on /tf; false where robot_state_publisher does", default=True
        ),
        ParameterSpec("frame_prefix", str, "prefix of the name of every frame on /tf", default=""),
    )
    HAS_ARM = True

    def __init__(self) -> None:
        super().__init__()
        self._chain = joint_chain(self.arm)
        self._instants: StampJoiner[int, _Joints] = StampJoiner(range(self.arm.n_sections))
        self.diagnostics.values |= {
            "instants waiting for a section": lambda: self._instants.waiting,
            "instants given up with a section missing": lambda: self._instants.incomplete + self._instants.late,
        }
        self._publish_pose = self.offer(PoseStamped, "tip_pose")
        self._publish_twist = self.offer(TwistStamped, "tip_twist")
        self._publish_frames = self.offer(TFMessage, "/tf", TRANSFORMS) if self.values["publish_tf"] else None
        self.listen(JointState, "joint_states", self._on_joints)

    def _on_joints(self, message: JointState) -> None:
        messages.stamped(message.header.stamp)
        index, found = read_names(message), dict[int, _Joints]()
        for i, section in enumerate(self.arm.sections):
            bends = read_bends(index, message.position, section)
            if bends is not None:
                rates = (
                    read_bend_rates(index, message.position, message.velocity, section) if message.velocity else None
                )
                found[i] = _Joints(bends, rates)
        if not found:
            raise MessageFault(messages.MISSING_NAME, "no joint of this arm is in the message")
        for i, joints in found.items():
            instant = self._instants.add(i, nanoseconds(message.header.stamp), joints)
            if instant is not None:
                self._answer([instant[k] for k in range(self.arm.n_sections)], message)

    def _answer(self, sections: list[_Joints], message: JointState) -> None:
        bends, rates = [one.bends for one in sections], [one.rates for one in sections if one.rates is not None]
        found, pose = tip_pose(bends, self._chain), PoseStamped()
        pose.header.stamp, pose.header.frame_id = message.header.stamp, BASE_FRAME
        place, turn = pose.pose.position, pose.pose.orientation
        place.x, place.y, place.z = map(float, found[:3, 3])
        turn.x, turn.y, turn.z, turn.w = map(float, Rotation.from_matrix(found[:3, :3]).as_quat(canonical=True))
        self._publish_pose(pose)
        if self._publish_frames is not None:
            self._publish_frames(disc_transforms(bends, self.arm, message.header.stamp, self.values["frame_prefix"]))
        if len(rates) == len(bends):
            velocity, twist = tip_twist(bends, rates, self._chain), TwistStamped()
            twist.header = pose.header
            linear, angular = twist.twist.linear, twist.twist.angular
            linear.x, linear.y, linear.z = map(float, velocity[:3])
            angular.x, angular.y, angular.z = map(float, velocity[3:])
            self._publish_twist(twist)

"""Targets of the arm's tip from a trajectory: checked poses and twists in ``base_link``."""

from __future__ import annotations

from dataclasses import dataclass

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, TwistStamped

from continuum.arrays import Array
from continuum_manipulator.nodekit import messages

BASE_FRAME = "base_link"


@dataclass(frozen=True)
class TipPose:
    """Position (3,) [m] and direction of the z axis (3,) of the tip."""

    stamp: Time
    position: Array
    direction: Array


@dataclass(frozen=True)
class TipTwist:
    """Linear (3,) [m/s] and angular velocity (3,) [rad/s] of the tip."""

    stamp: Time
    linear: Array
    angular: Array


def read_pose(message: PoseStamped) -> TipPose:
    """Check a pose.

    Raises:
        MessageFault: the stamp is missing, the frame is wrong, a value is not finite, or the quaternion is zero.
    """
    messages.stamped(message.header.stamp)
    messages.frame("frame_id", message.header.frame_id, BASE_FRAME)
    position = messages.finite_vector("position", message.pose.position)
    return TipPose(message.header.stamp, position, messages.z_axis("orientation", message.pose.orientation))


def read_twist(message: TwistStamped) -> TipTwist:
    """Check a twist.

    Raises:
        MessageFault: the stamp is missing, the frame is wrong, or a value is not finite.
    """
    messages.stamped(message.header.stamp)
    messages.frame("frame_id", message.header.frame_id, BASE_FRAME)
    linear = messages.finite_vector("linear", message.twist.linear)
    return TipTwist(message.header.stamp, linear, messages.finite_vector("angular", message.twist.angular))

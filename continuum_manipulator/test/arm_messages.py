"""Messages of the arm of the tests, and what the library says they must become."""

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, TwistStamped
from harness import ARM_FILE
from sensor_msgs.msg import JointState

from continuum.arm import load_arm
from continuum_manipulator.arm_joints import arm_joint_names, arm_joint_values
from continuum_manipulator.nodekit.stamps import nanoseconds
from continuum_msgs.msg import CableStates

ARM = load_arm(ARM_FILE)
NAMES = list(arm_joint_names(ARM))


def stamp(instant: int) -> Time:
    """The stamp of an instant, 10 ms apart."""
    return Time(sec=100 + instant // 100, nanosec=instant % 100 * 10_000_000)


def instant_of(message) -> int:
    """The instant that :func:`stamp` gave a message."""
    return (nanoseconds(message.header.stamp) - 100_000_000_000) // 10_000_000


def postures(n: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Configurations (n, 3, 2) [rad] and rates [rad/s]."""
    rng = np.random.default_rng(seed)
    return rng.uniform(-1.0, 1.0, (n, 3, 2)), rng.uniform(-2.0, 2.0, (n, 3, 2))


def joint_state(instant: int, w: np.ndarray, rate: np.ndarray | None = None) -> JointState:
    positions, velocities = arm_joint_values(w, rate, ARM)
    message = JointState(name=NAMES, position=positions)
    message.header.stamp = stamp(instant)
    if velocities is not None:
        message.velocity = velocities
    return message


def cables(instant: int, section: int, names, position, velocity=()) -> CableStates:
    message = CableStates(section=section, name=list(names), position=list(position), velocity=list(velocity))
    message.header.stamp = stamp(instant)
    return message


def pose(instant: int, position, frame: str = "base_link") -> PoseStamped:
    message = PoseStamped()
    message.header.stamp = stamp(instant)
    message.header.frame_id = frame
    message.pose.position.x, message.pose.position.y, message.pose.position.z = map(float, position)
    return message


def twist(instant: int, linear, frame: str = "") -> TwistStamped:
    message = TwistStamped()
    message.header.stamp = stamp(instant)
    message.header.frame_id = frame
    message.twist.linear.x, message.twist.linear.y, message.twist.linear.z = map(float, linear)
    return message

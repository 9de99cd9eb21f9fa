"""Messages of an arm with one section that bends in a plane, simulated or real."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from sensor_msgs.msg import JointState

from continuum import joint_names
from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.planar.cable_lengths import SIDES, cable_lengths, cable_rates
from continuum_msgs.msg import CableStates


class PlanarArm:
    """Names and messages of a planar arm.

    Args:
        section: name of the section.
        model: model of the arm.

    Attributes:
        joints, cables: names of joints and cables, in the order of the messages.

    Raises:
        InvalidValueError: the name of the section is not allowed, or joint torques drive the model.
    """

    def __init__(self, section: str, model: Model) -> None:
        joint_names.check_section(section)
        model.require_cables("this node")
        self._model = model
        self.joints = [
            joint_names.phi_joint(section),
            *joint_names.theta_joints(section, model.n_joints),
            joint_names.phi_back_joint(section),
        ]
        self.cables = list(joint_names.cable_names(section, len(SIDES)))

    def joint_state(self, stamp: Time, angles: Array, rates: Array) -> JointState:
        """Return the message of joint angles (n,) [rad] and rates [rad/s]; joints have no motors, hence no efforts."""
        message = JointState(name=self.joints)
        message.header.stamp = stamp
        message.position = [0.0, *angles, 0.0]  # positive bends are towards phi = 0
        message.velocity = [0.0, *rates, 0.0]
        return message

    def cable_states(self, stamp: Time, angles: Array | None, rates: Array | None, tensions: Array) -> CableStates:
        """Return the message for joint angles (n,) [rad] and rates [rad/s], or None, and tensions (n_cables,) [N]."""
        message = CableStates(section=CableStates.WHOLE_ARM, name=self.cables, effort=tensions)
        message.header.stamp = stamp
        if angles is not None and rates is not None:
            message.position = cable_lengths(angles, self._model.parameters)
            message.velocity = cable_rates(angles, rates, self._model.parameters)
        return message

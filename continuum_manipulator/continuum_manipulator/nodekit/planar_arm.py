"""Messages of an arm with one section that bends in a plane, simulated or real."""

from __future__ import annotations

from collections.abc import Mapping

from builtin_interfaces.msg import Time
from sensor_msgs.msg import JointState

from continuum import joint_names
from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_named_model
from continuum.dynamics.planar.cable_lengths import SIDES, cable_lengths, cable_rates
from continuum.parameter_spec import ParameterSpec, Value
from continuum_msgs.msg import CableStates

SECTION = ParameterSpec(
    "section", str, "name of the section, the prefix of the names of joints and cables; empty for the only section of "
    f"an arm file, and for {joint_names.DEFAULT_SECTION} with a model file", default="",
)  # fmt: skip


class PlanarArm:
    """Names and messages of a planar arm.

    Args:
        section: name of the section.
        model: model of the arm.

    Attributes:
        section, model: as given.
        joints, cables: names of joints and cables, in the order of the messages.

    Raises:
        InvalidValueError: the name of the section is not allowed, or joint torques drive the model.
    """

    def __init__(self, section: str, model: Model) -> None:
        joint_names.check_section(section)
        model.require_cables("this node")
        self.section = section
        self.model = model
        self.joints = [
            joint_names.phi_joint(section),
            *joint_names.theta_joints(section, model.n_joints),
            joint_names.phi_back_joint(section),
        ]
        self.cables = list(joint_names.cable_names(section, len(SIDES)))

    @classmethod
    def of_parameters(cls, values: Mapping[str, Value]) -> PlanarArm:
        """Return the arm of a node's parameters ``model`` and ``section``.

        Raises:
            ContinuumError: there is no such model or section, or it is not allowed.
        """
        given = str(values["section"])
        model, section = load_named_model(str(values["model"]), given or None)
        return cls(section or given or joint_names.DEFAULT_SECTION, model)

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
            message.position = cable_lengths(angles, self.model.parameters)
            message.velocity = cable_rates(angles, rates, self.model.parameters)
        return message

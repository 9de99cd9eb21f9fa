"""Node of one section: configuration and cables from its joints, and joints from commanded cables."""

from __future__ import annotations

import numpy as np
from builtin_interfaces.msg import Time
from sensor_msgs.msg import JointState

from continuum.arrays import Array
from continuum.kinematics.cables import cable_lengths, configuration_cable_jacobian, configuration_from_cables
from continuum.kinematics.discs import even_bends
from continuum.kinematics.joint_chain import length_rates_of_joints, lengths_of_joints
from continuum.kinematics.routing import cables_through
from continuum.parameter_spec import ParameterSpec
from continuum_manipulator.arm_joints import arm_joint_names
from continuum_manipulator.command_checks import (
    TOLERANCE,
    check_configuration,
    check_fit,
    check_lengths,
    check_rates,
)
from continuum_manipulator.config_states import config_states, read_config
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.section_joints import (
    Configuration,
    joint_names,
    joint_values,
    read_bend_rates,
    read_bends,
    read_joints,
    read_names,
)
from continuum_manipulator.section_number import checked_section
from continuum_msgs.msg import CableStates, ConfigStates


class SectionNode(CheckedNode):
    """Converts ``joint_states`` to ``section_config_states`` and ``section_cable_states``, and commands to joints.

    Joints may bend differently: the configuration is the sum of the bends, and cables run straight from disc to disc.
    ``section_cable_commands`` for this section give ``section_joint_states``; ``section_config_commands`` give these
    and ``section_cable_states``. Each input message gives one message on each output, with the same stamp.
    """

    NAME = "section"
    PARAMETERS = (
        ParameterSpec("section", int, "number of the node's section, 1 at the base", lower=1),
        TOLERANCE,
    )
    HAS_ARM = True

    def __init__(self) -> None:
        super().__init__()
        self._number = checked_section(self.values["section"], self.arm)
        self._section = self.arm.sections[self._number - 1]
        self._cables = list(cables_through(self.arm, self._number - 1).names)
        self._joints = list(joint_names(self._section))
        self._joints_of_others = {*arm_joint_names(self.arm)} - {*self._joints}
        self._publish_config = self.offer(ConfigStates, "section_config_states")
        self._publish_cables = self.offer(CableStates, "section_cable_states")
        self._publish_joints = self.offer(JointState, "section_joint_states")
        self.listen(JointState, "joint_states", self._on_joints)
        self.listen(CableStates, "section_cable_commands", self._on_cables)
        self.listen(ConfigStates, "section_config_commands", self._on_config)

    def in_words(self) -> str:
        """Describe the section."""
        return f"{self._section.name}, {self._number} of {self.arm.n_sections}"

    def _on_joints(self, message: JointState) -> None:
        messages.stamped(message.header.stamp)
        messages.named(message.name, "joints", self._joints)
        index = read_names(message)
        state = read_joints(index, message.position, message.velocity, self._section)
        if state is None:
            if self._joints_of_others.isdisjoint(index):
                raise messages.nothing_known("joint", message.name, [*self._joints, *self._joints_of_others])
            self.diagnostics.ignored["joint_states"] += 1
            return
        self._publish_config_state(state, message.header.stamp)
        bends, rates = read_bends(index, message.position, self._section), None
        if message.velocity:
            rates = read_bend_rates(index, message.position, message.velocity, self._section)
        self._publish_cable_state(bends, rates, message.header.stamp)

    def _is_for_another(self, message: CableStates | ConfigStates, topic: str) -> bool:
        """Return whether a stamped command is for another section of the arm."""
        if checked_section(message.section, self.arm) != self._number:
            self.diagnostics.ignored[topic] += 1
            return True
        messages.stamped(message.header.stamp)
        return False

    def _on_config(self, message: ConfigStates) -> None:
        if self._is_for_another(message, "section_config_commands"):
            return
        state = read_config(message)
        check_configuration(state.w, [self._section])
        rates = None if state.rate is None else even_bends(state.rate, self._section)
        self._publish_config_state(state, message.header.stamp)
        self._publish_cable_state(even_bends(state.w, self._section), rates, message.header.stamp)
        self._publish_joint_states(state, message.header.stamp)

    def _on_cables(self, message: CableStates) -> None:
        if self._is_for_another(message, "section_cable_commands"):
            return
        messages.named(message.name, "cables", self._section.cable_names)
        messages.same_length("position", message.position, message.name)
        messages.same_length("velocity", message.velocity, message.name, optional=True)
        own = messages.indices_of(self._section.cable_names, message.name)
        lengths = messages.finite("position", np.asarray(message.position)[own])
        check_lengths(lengths, self._section.cable_names)
        w = configuration_from_cables(lengths, self._section)
        check_configuration(w, [self._section])
        of_posture, tolerance = cable_lengths(w, self._section), self.values[TOLERANCE.name]
        check_fit(lengths, of_posture, self._section.cable_names, tolerance)
        rate = None
        if message.velocity:
            velocities = messages.finite("velocity", np.asarray(message.velocity)[own])
            rate = configuration_cable_jacobian(lengths, self._section) @ velocities
            check_rates(rate)
        self._publish_joint_states(Configuration(w, rate), message.header.stamp)

    def _publish_config_state(self, state: Configuration, stamp: Time) -> None:
        config = config_states(state, self._section, self._number)
        config.header.stamp = stamp
        self._publish_config(config)

    def _publish_cable_state(self, bends: Array, rates: Array | None, stamp: Time) -> None:
        """Publish the cables for ``bends`` (n_joints, 2) [rad] of the joints and their ``rates`` [rad/s] or None."""
        cables = CableStates(section=self._number, name=self._cables)
        cables.header.stamp = stamp
        cables.position = lengths_of_joints(bends, self.arm, self._number - 1)
        if rates is not None:
            cables.velocity = length_rates_of_joints(bends, rates, self.arm, self._number - 1)
        self._publish_cables(cables)

    def _publish_joint_states(self, state: Configuration, stamp: Time) -> None:
        """Publish the joints of a configuration."""
        positions, velocities = joint_values(state, self._section)
        joints = JointState(name=self._joints, position=positions)
        joints.header.stamp = stamp
        if velocities is not None:
            joints.velocity = velocities
        self._publish_joints(joints)

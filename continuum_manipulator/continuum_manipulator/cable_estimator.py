"""Node that estimates configurations and their covariance from measured cable lengths, for example of encoders."""

from __future__ import annotations

import numpy as np
from builtin_interfaces.msg import Time
from sensor_msgs.msg import JointState

from continuum.arrays import Array
from continuum.kinematics.cable_estimate import (
    FEWEST_CABLES,
    TOLERANCE,
    CableEstimate,
    EstimateStatus,
    arm_of_cables,
    estimate_configuration,
)
from continuum.kinematics.cable_twist import arm_configuration_cable_jacobian
from continuum.parameter_spec import ParameterSpec
from continuum_manipulator.arm_joints import arm_joint_names, arm_joint_values
from continuum_manipulator.command_checks import check_configuration, check_lengths, check_rates
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.faults import MessageFault
from continuum_msgs.msg import CableStates, ConfigEstimate

NO_POSTURE = "lengths that no posture has"

STATUSES = {
    EstimateStatus.CONVERGED: ConfigEstimate.CONVERGED,
    EstimateStatus.INCONSISTENT: ConfigEstimate.INCONSISTENT,
}
"""Statuses of estimates that are published; with any other status the message is refused."""


class CableEstimatorNode(CheckedNode):
    """Converts ``measured_cable_states`` to ``section_config_estimates`` and ``estimated_joint_states``.

    The measured values are total lengths from the base to each cable's anchor, by name in any order; cables may be
    missing as long as each section keeps three. The configurations are the least-squares solution over all cables, with
    their covariance. Velocities of the cables give velocities of the joints. Lengths that no posture has are refused.
    """

    NAME = "cable_estimator"
    PARAMETERS = (
        ParameterSpec("length_sd", float, "standard deviation of a measured length", "m", 1e-6, 0.1, default=1e-3),
        ParameterSpec(
            "tolerance", float, f"largest residual that counts as noise; 0 means {TOLERANCE:g} times length_sd",
            "m", 0.0, 1.0, default=0.0,
        ),
    )  # fmt: skip
    HAS_ARM = True

    def __init__(self) -> None:
        super().__init__()
        self._tolerance = self.values["tolerance"] or TOLERANCE * self.values["length_sd"]
        self._cables = list(self.arm.cable_names)
        self._joints = list(arm_joint_names(self.arm))
        self._publish_estimate = self.offer(ConfigEstimate, "section_config_estimates")
        self._publish_joints = self.offer(JointState, "estimated_joint_states")
        self.listen(CableStates, "measured_cable_states", self._on_cables)

    def _on_cables(self, message: CableStates) -> None:
        messages.stamped(message.header.stamp)
        if message.section != CableStates.WHOLE_ARM:
            raise MessageFault(
                messages.REFUSED,
                f"section is {message.section}; allowed: {CableStates.WHOLE_ARM}, lengths from the base to the anchors",
            )
        messages.named(message.name, "cables", self._cables)
        messages.positions_by_name(message.name)
        messages.no_others(self._cables, message.name)
        messages.same_length("position", message.position, message.name)
        messages.same_length("velocity", message.velocity, message.name, optional=True)
        check_lengths(messages.finite("position", message.position), message.name)
        messages.finite("velocity", message.velocity)
        lengths = self._in_order(message, message.position)
        self._check_enough(~np.isnan(lengths))
        found = estimate_configuration(lengths, self.arm, self.values["length_sd"], self._tolerance)
        self._check(found)
        rate = self._rate(found.w, self._in_order(message, message.velocity)) if message.velocity else None
        for i in range(self.arm.n_sections):
            self._publish_estimate(self._estimate_of(i, found, message.header.stamp))
        positions, velocities = arm_joint_values(found.w, rate, self.arm)
        joints = JointState(name=self._joints, position=positions)
        joints.header.stamp = message.header.stamp
        if velocities is not None:
            joints.velocity = velocities
        self._publish_joints(joints)

    def _in_order(self, message: CableStates, values: Array) -> Array:
        """Return values (n_cables,) in the arm's order, NaN for cables that are not in the message."""
        known = dict(zip(message.name, values, strict=True))
        return np.array([known.get(name, np.nan) for name in self._cables])

    def _check_enough(self, known: Array) -> None:
        first = 0
        for section in self.arm.sections:
            n = len(section.cable_names)
            missing = [name for name, one in zip(section.cable_names, known[first : first + n], strict=True) if not one]
            if n - len(missing) < FEWEST_CABLES:
                raise MessageFault(
                    messages.MISSING_NAME,
                    f"{', '.join(missing)} not in the message; {FEWEST_CABLES} cables of {section.name} are needed",
                )
            first += n

    def _check(self, found: CableEstimate) -> None:
        """Check that the estimate has converged, is within the bend limits, and agrees with the lengths.

        Raises:
            MessageFault: a residual is beyond the tolerance, or there is no estimate.
            InvalidValueError: a section is bent beyond its limit by more than noise explains.
        """
        if found.status is EstimateStatus.BEYOND_TOLERANCE:
            i = int(np.nanargmax(np.abs(found.residuals)))
            raise MessageFault(
                NO_POSTURE,
                f"residual of {self._cables[i]} is {found.residuals[i]:.4g} m, measured minus estimated; "
                f"allowed: up to the tolerance, {self._tolerance:g} m",
            )
        if found.status is EstimateStatus.BEYOND_LIMIT:
            check_configuration(found.w, self.arm.sections)
        if found.status not in STATUSES:
            raise MessageFault(NO_POSTURE, "no most likely posture was found")
        if found.status is EstimateStatus.INCONSISTENT:
            detail = f"chi-square is {found.chi_square:.3g} with {found.degrees_of_freedom} degrees of freedom"
            self.diagnostics.warnings.note("inconsistent lengths", detail)

    def _rate(self, w: Array, cable_rates: Array) -> Array:
        """Return the configuration rates (n_sections, 2) [rad/s] by least squares over the cable rates [m/s]."""
        known = ~np.isnan(cable_rates)
        measured = arm_of_cables(self.arm, tuple(known.tolist()))
        rate = (arm_configuration_cable_jacobian(w, measured) @ cable_rates[known]).reshape(w.shape)
        check_rates(rate)
        return rate

    def _estimate_of(self, index: int, found: CableEstimate, stamp: Time) -> ConfigEstimate:
        section = self.arm.sections[index]
        residuals = dict(zip(self._cables, found.residuals.tolist(), strict=True))
        names = [name for name in section.cable_names if not np.isnan(residuals[name])]
        u, v = found.w[index].tolist()
        message = ConfigEstimate(section=index + 1, u=u, v=v, name=names)
        message.header.stamp, message.header.frame_id = stamp, section.base_frame
        message.covariance = found.section_covariance(index).reshape(-1)
        message.residual = [residuals[name] for name in names]
        message.chi_square, message.degrees_of_freedom = found.chi_square, found.degrees_of_freedom
        message.status = STATUSES[found.status]
        return message

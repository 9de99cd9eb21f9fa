"""Joints of a section in ``sensor_msgs/JointState``: by name, to and from the configuration (thesis appendix A).

A section turns by phi at its base, bends by theta / n at each of its n joints, and turns back by -phi at its tip.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from sensor_msgs.msg import JointState

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.configuration import allen_from_jones, allen_rates, jones_from_allen, jones_rates
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.faults import MessageFault

STRAIGHT = 1e-12
"""Bend below which a section counts as straight [rad]: phi's rate grows without limit there and is not used."""


@dataclass(frozen=True)
class Configuration:
    """Configuration ``w`` (2,) [rad] of a section, and its rate (2,) [rad/s] where it is known."""

    w: Array
    rate: Array | None


def joint_names(section: Section) -> tuple[str, ...]:
    """Names of the section's joints from base to tip."""
    return (section.phi_joint, *section.theta_joints, section.phi_back_joint)


def joint_values(state: Configuration, section: Section) -> tuple[Array, Array | None]:
    """Positions (n_joints + 2,) [rad] and rates [rad/s], or None, of the joints of :func:`joint_names`.

    phi of the straight posture is free; it is chosen so that phi and theta can carry the rate.
    """
    phi, theta = jones_from_allen(state.w)
    if state.rate is None:
        return _distributed(phi, theta, section), None
    if theta < STRAIGHT:
        phi, theta_rate = jones_from_allen(state.rate)
        return _distributed(phi, np.float64(0.0), section), _distributed(np.float64(0.0), theta_rate, section)
    return _distributed(phi, theta, section), _distributed(*jones_rates(state.w, state.rate), section)


def read_joints(
    index: Mapping[str, int], positions: Sequence[float], velocities: Sequence[float], section: Section
) -> Configuration | None:
    """Configuration of the section from a message's joints; None where it has none of the section's.

    phi must be there, and of the theta joints either all, whose sum is theta, or the first alone, which leads them.

    Args:
        index: where each joint's name stands in the message.
        positions: [rad], one for each name.
        velocities: [rad/s], one for each name, or empty.
        section: the section.

    Raises:
        MessageFault: some of the joints are missing, a value is not finite, or the bend is not possible.
    """
    thetas = _theta_names(index, section)
    if not thetas:
        return None
    phi, angles = _phi_and_thetas("position", index, positions, thetas, section)
    theta = angles.sum()
    if not abs(theta) <= section.contact_bend:
        raise MessageFault(
            messages.REFUSED,
            f"bend of {section.name} is {theta:.6g} rad; allowed: up to {section.contact_bend:.6g} rad, "
            "where its discs meet",
        )
    theta = theta if abs(theta) >= STRAIGHT else np.float64(0.0)
    w = allen_from_jones(phi, theta)
    if not len(velocities):
        return Configuration(w, None)
    phi_rate, rates = _phi_and_thetas("velocity", index, velocities, thetas, section)
    return Configuration(w, allen_rates(phi, theta, phi_rate, rates.sum()))


def read_bends(index: Mapping[str, int], positions: Sequence[float], section: Section) -> Array | None:
    """Bends (n_joints, 2) [rad] of the section's joints, Allen's (u, v) of each; None where none is in the message.

    Joints that follow the first one are bent as it is. What is refused, and the arguments, are those of
    :func:`read_joints`.
    """
    if read_joints(index, positions, (), section) is None:
        return None
    return allen_from_jones(*_phi_and_thetas("position", index, positions, _theta_names(index, section), section))


def read_bend_rates(
    index: Mapping[str, int], positions: Sequence[float], velocities: Sequence[float], section: Section
) -> Array:
    """Rates (n_joints, 2) [rad/s] of what :func:`read_bends` reads, of a message that has the section's joints."""
    thetas = _theta_names(index, section)
    phi, angles = _phi_and_thetas("position", index, positions, thetas, section)
    phi_rate, rates = _phi_and_thetas("velocity", index, velocities, thetas, section)
    return allen_rates(np.full_like(angles, phi), angles, np.full_like(angles, phi_rate), rates)


def read_names(message: JointState) -> dict[str, int]:
    """Where each joint's name stands in a message whose arrays are one entry a name; rates and efforts may be missing.

    Raises:
        MessageFault: an array of another length, a rate or effort that is not finite, or a repeated name.
    """
    messages.same_length("position", message.position, message.name)
    for field in ("velocity", "effort"):
        values = getattr(message, field)
        messages.same_length(field, values, message.name, optional=True)
        messages.finite(field, values)
    return messages.positions_by_name(message.name)


def _theta_names(index: Mapping[str, int], section: Section) -> list[str]:
    """The section's theta joints in a message, all or the first alone; none where it has no joint of the section."""
    if index.keys().isdisjoint(joint_names(section)):
        return []
    thetas = [name for name in section.theta_joints if name in index]
    if section.phi_joint not in index or thetas not in (list(section.theta_joints), [section.theta_joints[0]]):
        missing = [section.phi_joint, *section.theta_joints]
        missing = [name for name in missing if name not in index]
        raise MessageFault(messages.MISSING_NAME, f"joints {', '.join(missing)} not in the message")
    return thetas


def _phi_and_thetas(
    field: str, index: Mapping[str, int], values: Sequence[float], thetas: Sequence[str], section: Section
) -> tuple[Array, Array]:
    """phi, and theta of every joint (n_joints,), also where the first alone is in the message."""
    for name in (section.phi_joint, *thetas):
        if not math.isfinite(values[index[name]]):
            raise MessageFault(
                messages.NOT_FINITE, f"{field} of {name} is {values[index[name]]}; a finite number is needed"
            )
    found = np.array([values[index[name]] for name in thetas])
    return np.float64(values[index[section.phi_joint]]), np.repeat(found, section.n_joints // len(thetas))


def _distributed(phi: Array, theta: Array, section: Section) -> Array:
    return np.concatenate([[phi], np.full(section.n_joints, theta / section.n_joints), [-phi]])

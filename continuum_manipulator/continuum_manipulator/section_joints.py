"""Conversion between joints of a section in ``sensor_msgs/JointState`` and its configuration (thesis appendix A).

A section rotates by phi at its base, bends by theta / n at each of its n joints, and rotates back by -phi at its tip.
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
"""Bend below which a section counts as straight [rad]: phi's rate is unbounded there and is not used."""


@dataclass(frozen=True)
class Configuration:
    """Configuration ``w`` (2,) [rad] of a section, and its rate (2,) [rad/s] if known."""

    w: Array
    rate: Array | None


def joint_names(section: Section) -> tuple[str, ...]:
    """Return the names of the section's joints from base to tip."""
    return (section.phi_joint, *section.theta_joints, section.phi_back_joint)


def joint_values(state: Configuration, section: Section) -> tuple[Array, Array | None]:
    """Return positions (n_joints + 2,) [rad] and rates [rad/s], or None, of the joints of :func:`joint_names`.

    In the straight posture phi is arbitrary; it is chosen so that phi and theta can represent the rate.
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
    """Return the section's configuration from a message; None if it contains none of the section's joints.

    phi must be present, and either all theta joints, whose sum is theta, or only the first, which the others mimic.

    Args:
        index: position of each joint's name in the message.
        positions: joint positions [rad], one for each name.
        velocities: joint velocities [rad/s], one for each name, or empty.
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
    """Return bends (n_joints, 2) [rad] of the section's joints, Allen's (u, v) of each; None if none is present.

    Joints that mimic the first one have the same bend. Arguments and faults are those of :func:`read_joints`.
    """
    if read_joints(index, positions, (), section) is None:
        return None
    return allen_from_jones(*_phi_and_thetas("position", index, positions, _theta_names(index, section), section))


def read_bend_rates(
    index: Mapping[str, int], positions: Sequence[float], velocities: Sequence[float], section: Section
) -> Array:
    """Return the rates (n_joints, 2) [rad/s] of the bends that :func:`read_bends` reads from the same message."""
    thetas = _theta_names(index, section)
    phi, angles = _phi_and_thetas("position", index, positions, thetas, section)
    phi_rate, rates = _phi_and_thetas("velocity", index, velocities, thetas, section)
    return allen_rates(np.full_like(angles, phi), angles, np.full_like(angles, phi_rate), rates)


def read_names(message: JointState) -> dict[str, int]:
    """Return the position of each joint's name, after checking the arrays; rates and efforts may be missing.

    Raises:
        MessageFault: an array has the wrong length, a rate or effort is not finite, or a name is repeated.
    """
    messages.same_length("position", message.position, message.name)
    for field in ("velocity", "effort"):
        values = getattr(message, field)
        messages.same_length(field, values, message.name, optional=True)
        messages.finite(field, values)
    return messages.positions_by_name(message.name)


def _theta_names(index: Mapping[str, int], section: Section) -> list[str]:
    """Return the section's theta joints in a message, all or only the first; empty without joints of the section."""
    if index.keys().isdisjoint(joint_names(section)):
        return []
    thetas = [name for name in section.theta_joints if name in index]
    if section.phi_joint not in index or thetas not in (list(section.theta_joints), [section.theta_joints[0]]):
        missing = [section.phi_joint, *section.theta_joints]
        missing = [name for name in missing if name not in index]
        strangers = [name for name in index if name.startswith(f"{section.name}_") and name not in joint_names(section)]
        hint = messages.misspelt(strangers, missing)
        raise MessageFault(messages.MISSING_NAME, f"joints {', '.join(missing)} not in the message{hint}")
    return thetas


def _phi_and_thetas(
    field: str, index: Mapping[str, int], values: Sequence[float], thetas: Sequence[str], section: Section
) -> tuple[Array, Array]:
    """Return phi, and theta of every joint (n_joints,), even if only the first is in the message."""
    for name in (section.phi_joint, *thetas):
        if not math.isfinite(values[index[name]]):
            raise MessageFault(
                messages.NOT_FINITE, f"{field} of {name} is {values[index[name]]}; a finite number is needed"
            )
    found = np.array([values[index[name]] for name in thetas])
    return np.float64(values[index[section.phi_joint]]), np.repeat(found, section.n_joints // len(thetas))


def _distributed(phi: Array, theta: Array, section: Section) -> Array:
    return np.concatenate([[phi], np.full(section.n_joints, theta / section.n_joints), [-phi]])

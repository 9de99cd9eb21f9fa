"""Forward kinematics and cable lengths of an arm whose joints bend by different angles: every joint is a section.

Eqs. 4, 8, 10, 11, 20, 21 and 26 also hold for sections of one joint, and the arm is a chain of such sections.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.cables import chord_jacobian, chords
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.routing import cables_through


def joint_chain(arm: Arm) -> Arm:
    """Return the arm with one section for each joint."""
    joints = [
        replace(
            section, name=f"{section.name}_joint_{k + 1}", n_joints=1, twist=section.twist if k == 0 else 0.0,
            bend_limit=section.bend_limit / section.n_joints,
        )
        for section in arm.sections
        for k in range(section.n_joints)
    ]  # fmt: skip
    return Arm(tuple(joints))


def tip_pose(bends: Sequence[Array], chain: Arm) -> Array:
    """Return the pose (4, 4) [m] of the tip in ``base_link``.

    Args:
        bends: for each section the bends of its joints, (n_joints, 2) [rad].
        chain: the arm's chain of joints, from `joint_chain`.
    """
    return arm_pose(np.concatenate(bends), chain)


def tip_twist(bends: Sequence[Array], rates: Sequence[Array], chain: Arm) -> Array:
    """Return the twist (6,) of the tip in ``base_link``: linear velocity [m/s], angular velocity [rad/s].

    Args:
        bends, rates: for each section the bends and rates of its joints, (n_joints, 2) [rad] and [rad/s].
        chain: the arm's chain of joints, from `joint_chain`.
    """
    w = np.concatenate(bends)
    return np.asarray(arm_jacobian(w, chain) @ np.concatenate(rates).reshape(-1))


def lengths_of_joints(bends: Array, arm: Arm, index: int) -> Array:
    """Return the lengths (..., n_cables) [m] within section ``index``: the chords of Eq. 8 summed over the joints.

    The cables are all those that run through the section.

    Args:
        bends: bends of the section's joints (..., n_joints, 2) [rad].
        arm: the arm.
        index: index of the section, 0 at the base.
    """
    routing = cables_through(arm, index)
    return np.asarray(chords(bends, arm.sections[index].b, 1, routing.a, routing.azimuths).sum(axis=-2))


def length_rates_of_joints(bends: Array, rates: Array, arm: Arm, index: int) -> Array:
    """Return the rates (..., n_cables) [m/s] of `lengths_of_joints` at ``rates`` (..., n_joints, 2) [rad/s]."""
    routing = cables_through(arm, index)
    jacobian = chord_jacobian(bends, arm.sections[index].b, 1, routing.a, routing.azimuths)
    return np.asarray((jacobian @ rates[..., None])[..., 0].sum(axis=-2))

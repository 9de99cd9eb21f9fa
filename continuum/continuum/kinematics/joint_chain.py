"""Forward kinematics and cable lengths of an arm whose joints bend by different angles: every joint is a section.

Eqs. 4, 8, 10, 20, 21, 11 and 26 hold for sections of one joint too, and the arm is the chain of these.
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
    """The arm with a section for each of its joints."""
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
    """Pose (4, 4) [m] of the tip in ``base_link``.

    Args:
        bends: for each section those of its joints, (n_joints, 2) [rad].
        chain: of the arm's joints, as `joint_chain` makes it.
    """
    return arm_pose(np.concatenate(bends), chain)


def tip_twist(bends: Sequence[Array], rates: Sequence[Array], chain: Arm) -> Array:
    """Twist (6,) of the tip in ``base_link``: linear velocity [m/s], angular velocity [rad/s].

    Args:
        bends, rates: for each section those of its joints, (n_joints, 2) [rad] and [rad/s].
        chain: of the arm's joints, as `joint_chain` makes it.
    """
    w = np.concatenate(bends)
    return np.asarray(arm_jacobian(w, chain) @ np.concatenate(rates).reshape(-1))


def lengths_of_joints(bends: Array, arm: Arm, index: int) -> Array:
    """Lengths (..., n_cables through it) [m] within section ``index``: at every joint the chord of Eq. 8, summed.

    Args:
        bends: of the section's joints (..., n_joints, 2) [rad].
        arm: the arm.
        index: of the section, 0 at the base.
    """
    routing = cables_through(arm, index)
    return np.asarray(chords(bends, arm.sections[index].b, 1, routing.a, routing.azimuths).sum(axis=-2))


def length_rates_of_joints(bends: Array, rates: Array, arm: Arm, index: int) -> Array:
    """Rates (..., n_cables through it) [m/s] of `lengths_of_joints`, at ``rates`` (..., n_joints, 2) [rad/s]."""
    routing = cables_through(arm, index)
    jacobian = chord_jacobian(bends, arm.sections[index].b, 1, routing.a, routing.azimuths)
    return np.asarray((jacobian @ rates[..., None])[..., 0].sum(axis=-2))

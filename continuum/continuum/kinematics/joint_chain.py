"""Forward kinematics of an arm whose joints bend by different angles: every joint a section of its own.

Eqs. 4, 10, 20, 21 and 11 hold for sections of one joint too, and the arm is the chain of these.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.chain import arm_jacobian, arm_pose


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

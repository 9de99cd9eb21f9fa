"""Sum of thesis Eq. 12: M theta'' + C theta' + K (theta - theta_0) + G + F - J_s^T W B u - tau, which must be zero.

tau is the torque of drives at the joints, which the thesis's arm does not have.
Integrators, statics, inverse dynamics and fits all call this one sum.
"""

from __future__ import annotations

from continuum.dynamics.expressions import Numbers, suffix_sum
from continuum.dynamics.planar.cable_torque import cable_torque
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.planar.rigid_body import (
    link_coriolis_torque,
    link_gravity_torque,
    link_inertia_times,
    rotor_torque,
)
from continuum.dynamics.planar.springs_and_friction import joint_friction, spring_torque


def torque_balance(now: Instant) -> Numbers:
    """Left side minus right side of Eq. 12, (n,) [N m]."""
    move, p = now.motion, now.p
    return (
        rigid_body_torque(now)
        + spring_torque(move.theta, p)
        + joint_friction(move.theta_rate, p, move.slip_rate)
        - cable_torque(move, now.u, p)
        - now.drive
    )


def rigid_body_torque(now: Instant) -> Numbers:
    """M theta'' + C theta' + G of Eq. 12, (n,) [N m], of links and drives."""
    return link_torque(now) + rotor_torque(now.motion.theta_acceleration, now.p)


def link_torque(now: Instant) -> Numbers:
    """The same sum for the links alone, (n,) [N m], in their absolute angles, which include a rotation of the base."""
    move, p = now.motion, now.p
    return suffix_sum(
        link_inertia_times(move.link_angle, move.link_acceleration, p)
        + link_coriolis_torque(move.link_angle, move.link_rate, p)
        + link_gravity_torque(move.link_angle, p)
    )

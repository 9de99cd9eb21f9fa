"""Thesis Eq. 12, right-hand side: torque of the cables at the joints, J_s^T W B u."""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, positive_part
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.eq15_tension_propagation import tension_propagation
from continuum.dynamics.planar.eq16_link_wrenches import link_wrenches
from continuum.dynamics.planar.eq17_serial_jacobian import serial_jacobian_transposed_times
from continuum.dynamics.planar.motion import Motion


def cable_torque(move: Motion, u: Numbers, p: Parameters) -> Numbers:
    """J_s^T W B u, (n,) [N m]; nothing where the arm has no cables.

    Args:
        move: of the joints and links.
        u: tension of each cable at the base, (n_cables,) [N]; below 0 there is none, a cable cannot push.
        p: parameters.
    """
    if not p.has_cables:
        return np.zeros(p.n_joints)
    local = tension_propagation(move.theta, move.slip_rate, p) * positive_part(u)
    return serial_jacobian_transposed_times(link_wrenches(local, move.theta, p), move.link_angle, p)

"""Thesis Eq. 12, K: torque of the joints' springs, K (theta - theta_0), K diagonal."""

from __future__ import annotations

from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameters


def spring_torque(theta: Numbers, p: Parameters) -> Numbers:
    """K (theta - theta_0), (n,) [N m], of joint angles (n,) [rad]."""
    return p.stiffness * (theta - p.rest_angle)


def spring_potential(theta: Numbers, p: Parameters) -> Numbers:
    """Energy in each spring, (n,) [J]."""
    return spring_torque(theta, p) * (theta - p.rest_angle) / 2

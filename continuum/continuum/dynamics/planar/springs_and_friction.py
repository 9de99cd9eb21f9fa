"""Thesis Eqs. 12 and 13, K and F: springs, and viscous and Coulomb friction with the Stribeck effect (Egle 2021).

F_i = tau_mu w + tau_c tanh(k_v w) (1 + S exp(-(w / v_d)^2)), with the joint's rate w; the sign is smoothed at the
origin. The square is printed outside the exponential; inside, it makes the factor even in w, as friction requires.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, smooth_sign
from continuum.dynamics.parameters import Parameters


def spring_torque(theta: Numbers, p: Parameters) -> Numbers:
    """K (theta - theta_0) of Eq. 12 with diagonal K, (n,) [N m], for joint angles (n,) [rad]."""
    return p.stiffness * (theta - p.rest_angle)


def spring_potential(theta: Numbers, p: Parameters) -> Numbers:
    """Energy in each spring, (n,) [J]."""
    return spring_torque(theta, p) * (theta - p.rest_angle) / 2


def joint_friction(theta_rate: Numbers, p: Parameters, slip_rate: Numbers | None = None) -> Numbers:
    """Eq. 13: F(theta'), (n,) [N m]; on the left side of Eq. 12 it opposes the motion.

    Args:
        theta_rate: rates of the joints, (n,) [rad/s].
        p: parameters.
        slip_rate: rates in the dry friction terms, `Motion.slip_rate`, (n,) [rad/s]; ``theta_rate`` by default.
    """
    slip = theta_rate if slip_rate is None else slip_rate
    return p.viscous_friction * theta_rate + dry_friction(slip, p) * smooth_sign(slip, p.friction_slope)


def dry_friction(theta_rate: Numbers, p: Parameters) -> Numbers:
    """Magnitude of the dry friction of Eq. 13 at a rate, tau_c (1 + S exp(-(w / v_d)^2)), (n,) [N m]."""
    return p.coulomb_friction * (1 + p.stribeck_gain * np.exp(-((theta_rate / p.stribeck_speed) ** 2)))


def break_away_torque(p: Parameters) -> Numbers:
    """Largest torque that the friction of a resting joint holds, tau_c (1 + S), (n,) [N m]."""
    return dry_friction(np.zeros(1), p)

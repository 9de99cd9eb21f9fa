"""Thesis Eq. 13, F: viscous and Coulomb friction with the Stribeck effect, smoothed at the origin (Egle 2021).

F_i = tau_mu w + tau_c tanh(k_v w) (1 + S exp(-(w / v_d)^2)), w the joint's rate. The printed square stands outside of
the exponential; inside, it makes the factor even in w, as friction must be.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, smooth_sign
from continuum.dynamics.parameters import Parameters


def joint_friction(theta_rate: Numbers, p: Parameters, slip_rate: Numbers | None = None) -> Numbers:
    """F(theta'), (n,) [N m], against the motion: it stands on the left of Eq. 12.

    Args:
        theta_rate: of the joints, (n,) [rad/s].
        p: parameters.
        slip_rate: the same as dry friction sees it, `Motion.slip_rate`, (n,) [rad/s]; ``theta_rate`` without.
    """
    slip = theta_rate if slip_rate is None else slip_rate
    return p.viscous_friction * theta_rate + dry_friction(slip, p) * smooth_sign(slip, p.friction_slope)


def dry_friction(theta_rate: Numbers, p: Parameters) -> Numbers:
    """Size of the dry friction at a rate, tau_c (1 + S exp(-(w / v_d)^2)), (n,) [N m]."""
    return p.coulomb_friction * (1 + p.stribeck_gain * np.exp(-((theta_rate / p.stribeck_speed) ** 2)))


def break_away_torque(p: Parameters) -> Numbers:
    """Largest torque that a resting joint holds, tau_c (1 + S), (n,) [N m]."""
    return dry_friction(np.zeros(1), p)

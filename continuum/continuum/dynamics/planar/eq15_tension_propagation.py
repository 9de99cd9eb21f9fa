"""Thesis Eqs. 14 and 15, B: what is left of a cable's tension in each module after the discs before it.

At every disc a cable loses or gains by the capstan law T_(i+1) = T_i exp(-+ mu_c wrap). The wrap is an absolute
value: half the first joint's angle at the base plate, half the sum of its two joints' angles at disc i, which adds up
to the printed theta_1 + ... + theta_i / 2 for an arm bent to one side. The loss follows the cable's motion over that
very disc: where the cable beyond it grows shorter, tension falls towards the tip, as printed; where it grows longer,
tension rises.
"""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, smooth_sign, suffix_sum
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.cables import chord_jacobian


def tension_propagation(theta: Numbers, slip_rate: Numbers, p: Parameters) -> Numbers:
    """B(theta, theta'): tension in each module for one newton at the base, (n, n_cables).

    Args:
        theta, slip_rate: of the joints, (n,) [rad, rad/s].
        p: parameters.
    """
    taken_in = -suffix_sum(chord_jacobian(theta, p) * slip_rate[:, None])  # cable speed over each disc [m/s]
    losing = smooth_sign(taken_in, p.cable_slope)
    return np.exp(-p.capstan_friction * np.cumsum(losing * wrap_angles(theta)[:, None], axis=0))


def wrap_angles(theta: Numbers) -> Numbers:
    """Angle by which a cable turns at the base plate and at each disc but the last, (n,) [rad]."""
    before = np.concatenate([np.zeros(1), theta[:-1]])
    return np.abs(before + theta) / 2

"""The capstan law: tension that a cable loses to friction at the discs, Eqs. 14 and 15."""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, smooth_sign, suffix_sum
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.cable_lengths import chord_jacobian


def tension_propagation(theta: Numbers, slip_rate: Numbers, p: Parameters) -> Numbers:
    """Eqs. 14 and 15, B(theta, theta'): tension in each module for a tension of 1 N at the base, (n, n_cables).

    At every disc the tension changes by the capstan law T_(i+1) = T_i exp(-+ mu_c wrap). The sign depends on the
    cable's motion over that disc: where the cable beyond the disc gets shorter, tension falls towards the tip, as
    printed; where it gets longer, tension rises.

    Args:
        theta, slip_rate: angles and rates of the joints, (n,) [rad, rad/s].
        p: parameters.
    """
    taken_in = -suffix_sum(chord_jacobian(theta, p) * slip_rate[:, None])  # cable speed over each disc [m/s]
    losing = smooth_sign(taken_in, p.cable_slope)
    return np.exp(-p.capstan_friction * np.cumsum(losing * wrap_angles(theta)[:, None], axis=0))


def wrap_angles(theta: Numbers) -> Numbers:
    """Wrap angle of Eq. 14: the deflection of a cable at the base plate and at each disc but the last, (n,) [rad].

    It is an absolute value: half the first joint's angle at the base plate, and half the sum of the angles of its two
    joints at a disc. These add up to the printed theta_1 + ... + theta_i / 2 for an arm bent to one side.
    """
    before = np.concatenate([np.zeros(1), theta[:-1]])
    return np.abs(before + theta) / 2

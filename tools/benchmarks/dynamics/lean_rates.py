"""Eq. 18 for slack cables in plain NumPy, written for speed: the right-hand side of the baseline.

It uses the links' absolute angles, which take the fewest operations. A test checks it against the library's Eq. 18.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.rigid_body import link_coupling, mass_moments


def lean_rates(p: Parameters) -> Callable[[float, Array], Array]:
    """``f(t, x)``, (2 n,), of the state x = (theta, theta') (2 n,) [rad, rad/s]."""
    n, A, inertia, weight = p.n_joints, link_coupling(p), np.diag(p.inertia), p.gravity * mass_moments(p)

    def rates(_: float, x: Array) -> Array:
        theta, rate = x[:n], x[n:]
        angle, speed = np.cumsum(theta), np.cumsum(rate)
        apart = angle[:, None] - angle
        friction = p.coulomb_friction * (1 + p.stribeck_gain * np.exp(-((rate / p.stribeck_speed) ** 2)))
        torque = p.stiffness * (theta - p.rest_angle) + p.viscous_friction * rate
        torque += friction * np.tanh(p.friction_slope * rate)
        torque[:-1] -= torque[1:]  # torque on a link: that of its joint minus that of the next joint
        left = torque + (A * np.sin(apart)) @ speed**2 + weight * np.sin(p.hang_angle + angle)
        acceleration = np.linalg.solve(A * np.cos(apart) + inertia, -left)
        acceleration[1:] -= acceleration[:-1].copy()
        return np.concatenate([rate, acceleration])

    return rates

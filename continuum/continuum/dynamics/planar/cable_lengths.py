"""The course of the two cables of a planar section: Eq. 8 in the plane.

Cable 1 runs at x = +a and bends the arm towards positive angles, cable 2 at x = -a. The chord of a cable in a module
with joint angle theta is l = 2 (b cos(theta / 2) - side a sin(theta / 2)): Eq. 8 with one joint.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameters

SIDES = np.array([1.0, -1.0])
"""Side of each cable, (n_cables,)."""


def chord_lengths(theta: Numbers, p: Parameters) -> Numbers:
    """Length of each cable in each module, (n, n_cables) [m]: Eq. 8 with one joint."""
    half = theta[:, None] / 2
    return 2 * (p.half_spacing[:, None] * np.cos(half) - SIDES * p.hole_radius[:, None] * np.sin(half))


def chord_jacobian(theta: Numbers, p: Parameters) -> Numbers:
    """d l / d theta of `chord_lengths`, (n, n_cables) [m/rad]."""
    half = theta[:, None] / 2
    return -(p.half_spacing[:, None] * np.sin(half) + SIDES * p.hole_radius[:, None] * np.cos(half))


def cable_lengths(theta: Array, p: Parameters) -> Array:
    """Length of each cable from the base plate to the last disc, (n_cables,) [m]."""
    return np.asarray(chord_lengths(theta, p).sum(axis=0))


def cable_rates(theta: Array, rate: Array, p: Parameters) -> Array:
    """Rate of each cable length, positive when the cable gets longer, (n_cables,) [m/s]."""
    return np.asarray(rate @ chord_jacobian(theta, p))

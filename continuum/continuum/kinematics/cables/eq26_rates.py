"""Thesis Eqs. 25 and 26: rates of the cables through a section. The printed phi entry lost a square: docs/errata.md."""

from __future__ import annotations

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.cables.eq08_lengths import bend_towards, cable_holes
from continuum.kinematics.configuration import bend
from continuum.kinematics.smooth_functions import sinc, sinc_derivative


def cable_jacobian(w: Array, section: Section, a: Array | None = None, azimuths: Array | None = None) -> Array:
    """Slopes d length / d(u, v), (..., n_cables, 2) [m/rad], at ``w`` (..., 2) [rad]; arguments as for Eq. 8."""
    return chord_jacobian(w, section.b, section.n_joints, *cable_holes(section, a, azimuths))


def chord_jacobian(w: Array, b: Array | float, n_joints: Array | float, a: Array, azimuths: Array) -> Array:
    """Slopes (..., n_cables, 2) [m/rad] of :func:`~continuum.kinematics.cables.eq08_lengths.chords`; same arguments."""
    n = n_joints
    x = bend(w)[..., None] / (2 * n)
    towards = np.stack([-np.sin(azimuths), np.cos(azimuths)], axis=-1)
    along_bend = -b * sinc(x) / (2 * n) - a * sinc_derivative(x) / (4 * n * n) * bend_towards(w, azimuths)
    jacobian: Array = along_bend[..., None] * w[..., None, :] - (a * sinc(x))[..., None] * towards
    return jacobian

"""Thesis Eq. 9, FK_spe: configuration of a section from its cables. Printed form: see docs/errata.md.

Cable j of a section measures l_j = C - a (X cos alpha_j + Y sin alpha_j), where (X, Y) = 2 n_j sin x (cos phi, sin phi)
and C = 2 n_j b cos x. Three cables or more give (X, Y, C) by linear least squares, and the module's chord points along
(X, Y, C / b): Eq. 5 applied to it gives one module's bend. Four cables a quarter turn apart give the thesis's Eq. 9.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.kinematics.section.eq05_configuration_from_point import configuration_from_point
from continuum.kinematics.section.eq22_rates_from_point import configuration_from_point_jacobian


def configuration_from_cables(lengths: Array, section: Section) -> Array:
    """Configuration ``w`` (..., 2) [rad] from the lengths (..., n_cables) [m] of the section's actuating cables.

    Lengths that no configuration has are projected: least squares over all cables.
    """
    return section.n_joints * configuration_from_point(lengths @ _point_of_lengths(section).T)


def configuration_cable_jacobian(lengths: Array, section: Section) -> Array:
    """d(u, v) / d length, (..., 2, n_cables) [rad/m], at ``lengths`` (..., n_cables) [m]."""
    matrix = _point_of_lengths(section)
    return section.n_joints * configuration_from_point_jacobian(lengths @ matrix.T) @ matrix


@lru_cache
def _point_of_lengths(section: Section) -> Array:
    """Matrix (3, n_cables) that gives (X, Y, C / b), the direction of one module's chord, from the cables' lengths.

    It is kept, since a stream of messages asks for it again and again.
    """
    azimuths = np.asarray(section.cable_azimuths)
    measured = np.stack(
        [-section.a * np.cos(azimuths), -section.a * np.sin(azimuths), np.full_like(azimuths, section.b)], axis=-1
    )
    return np.linalg.pinv(measured)

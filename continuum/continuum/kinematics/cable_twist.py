"""Twist of the tip from cable rates, thesis Eq. 11: J_xq = J_x,zeta J_zeta,q, for an arm of any number of sections.

J_x,zeta is the arm's geometric jacobian (Eqs. 20, 21, chained). An arm has more cables than coordinates, so J_q,zeta
(Eq. 26, summed by `tangle`) has many left inverses. They all agree on rates that belong to a motion of the arm. For
measured rates this module uses the pseudoinverse, which is the least-squares solution over all cables;
`untangle_rates` uses only the cables that actuate a section and ignores those that pass through it.
"""

from __future__ import annotations

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.chain import arm_jacobian
from continuum.kinematics.routing import tangle_jacobian


def arm_configuration_cable_jacobian(w: Array, arm: Arm) -> Array:
    """J_zeta,q: configurations by cable lengths, (..., 2 n_sections, n_cables) [rad/m], at ``w`` (..., n_sections, 2).

    Rows: u, v of section 1, of section 2, ...; columns: total lengths, as `tangle` orders them.
    """
    return np.asarray(np.linalg.pinv(tangle_jacobian(w, arm)))


def tip_cable_jacobian(w: Array, arm: Arm) -> Array:
    """J_xq: twist of the tip per rate of each total length, (..., 6, n_cables), at ``w`` (..., n_sections, 2) [rad].

    Rows: linear velocity of the tip in ``base_link`` [m/m], angular velocity [rad/m].
    """
    return np.asarray(arm_jacobian(w, arm) @ arm_configuration_cable_jacobian(w, arm))

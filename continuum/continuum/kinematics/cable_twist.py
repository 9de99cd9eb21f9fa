"""Thesis Eq. 11 from the cables to the tip: J_xq = J_x,zeta J_zeta,q, for an arm of any number of sections.

J_x,zeta is the arm's geometric jacobian (Eqs. 20, 21, chained). An arm has more cables than coordinates, so J_q,zeta
(Eq. 26, summed by `tangle`) has many left inverses. All give the same for rates that a motion of the arm has. For
measured rates the pseudoinverse is taken: it is the least squares over all cables, whereas `untangle_rates` uses the
cables that actuate a section and leaves out what those that pass it say of it.
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

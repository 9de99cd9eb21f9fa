"""Dry friction proportional to the force N in the joint: radius N (1 + S_N exp(-(w / v_d)^2)) tanh(k_v w).

The radius is that of the pin times the coefficient of friction. N is the force that a joint transmits to the links
beyond it: it carries their weight, provides their centripetal force at the present rates, and balances the cable
tensions of the module, which compress the joint. The part due to accelerations is neglected, so that the equations stay
linear in the accelerations. N is rounded to at least 0.1 N where these forces cancel. The Stribeck gain of
load-dependent friction may differ from that of grease and preload, hence the separate parameter S_N (Bittencourt and
Gunnarsson measured both).

Five links of 0.22 kg load joint 1 with 11 N and joint 5 with 2 N. A pin radius of 10 mm and mu = 0.3 (dry plastics, 0.2
to 0.5) give 3 mm, which is 0.03 N m at joint 1 and 0.006 N m at joint 5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers, smooth_sign
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.planar.springs_and_friction import dry_friction
from continuum.effects._parts import joint_force

_LEAST_FORCE = 0.1  # N


class LoadFriction(Effect):
    """Friction of loaded pins."""

    name = "load_friction"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "radius": Parameter(
            "rho", "m", 0.0, 0.1, False, "radius of a joint's pin times its coefficient of friction", 0.0, 1e-3
        ),
        "stribeck": Parameter(
            "S_N", "1", 0.0, 20.0, False, "Stribeck gain of the load-dependent friction", 0.0, 0.7, shape=True
        ),
    }
    source = (
        "Hamon, Gautier and Garrec, IEEE/RSJ IROS 2010 (dry friction depending on load and velocity); "
        "Bittencourt and Gunnarsson, ASME JDSMC 134, 2012, 051013 (Coulomb and Stribeck part grow with load)"
    )
    in_words = "Joint friction grows with the weight and the cable tension that a joint carries."
    symptom = "Joints near the base stick more than those near the tip, and all stick more when cables pull."
    experiment = "Release the arm with and without a weight on its tip, or pull both cables alike while it swings."

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        w, p = now.motion.slip_rate, now.p
        force = joint_force(now)
        size = np.sqrt((force * force).sum(axis=1) + _LEAST_FORCE**2)
        rubbing = replace(p, coulomb_friction=params["radius"] * size, stribeck_gain=params["stribeck"])
        return dry_friction(w, rubbing) * smooth_sign(w, p.friction_slope)

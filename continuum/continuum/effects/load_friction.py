"""Dry friction that grows with the force N in the joint: radius N (1 + S_N exp(-(w / v_d)^2)) tanh(k_v w).

The radius is the pin's times the coefficient of friction. N is the force that joint i passes on to what lies beyond
it: its weight, what keeps its mass on its curved way (centripetal, of the joints' present rates; the part of their
accelerations is left out, so that the equations stay linear in them), and the pull of the cables in module i, which
presses the joint together. N is rounded to at least 0.1 N where these cancel. Where a load breaks away it need not rub
more in the same ratio as grease and preload do, hence an S_N of its own (Bittencourt and Gunnarsson measured both).

Five links of 0.22 kg hang on joint 1 with 11 N, on joint 5 with 2 N. A pin of 10 mm and mu = 0.3 (dry plastics,
0.2 to 0.5) make 3 mm, 0.03 N m in joint 1 and 0.006 N m in joint 5.
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
    """Friction of a loaded pin."""

    name = "load_friction"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "radius": Parameter("rho", "m", 0.0, 0.1, False, "radius of a joint's pin times its friction", 0.0, 1e-3),
        "stribeck": Parameter(
            "S_N", "1", 0.0, 20.0, False, "Stribeck gain of what the load adds", 0.0, 0.7, shape=True
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

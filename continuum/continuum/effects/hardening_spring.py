"""Springs that stiffen as they bend: K_3 (theta - theta_0)^3 in addition to K (theta - theta_0).

The cubic term is the lowest nonlinear term of a symmetric spring (Duffing). At 0.4 rad, 2 N m/rad^3 add 0.13 N m to the
0.5 N m of K = 1.24 N m/rad. A negative K_3 describes a softening spring.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.planar.instant import Instant


class HardeningSpring(Effect):
    """A cubic spring in every joint."""

    name = "hardening_spring"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "cubic": Parameter("K_3", "N m/rad3", -2.0, 100.0, False, "cubic stiffness of all joints", 0.0, 2.0)
    }
    source = "Kovacic and Brennan (eds.), The Duffing Equation, Wiley 2011, ch. 2"
    in_words = "The springs get stiffer the further they bend."
    symptom = "Large swings are faster than small ones, and a large load bends the joints less than proportionally."
    experiment = (
        "Hang increasing weights on the tip and read the joint angles at rest: the load over the angle curves upwards."
    )

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        return params["cubic"] * (now.motion.theta - now.p.rest_angle) ** 3

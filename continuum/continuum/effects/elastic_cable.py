"""A cable is a spring between the arm and a motor that gives way: T' = k (motor speed + lengthening speed).

The motor winds with v = alpha (u - T), an admittance, alpha = 1 / (k lag); the lengthening L is the cable's way
through the arm, which the joints stretch:

  lag T' = r,      r = u - T + lag k L',      times tanh(T / 0.05 N) where r < 0: T stays positive.

Without a lag the motor makes up for every stretch at once and the tension is what it is told. A motor that is told
none still lets its drum turn only against that resistance, so that an arm that draws its cable out feels it. Cable
that comes loose is wound up at once, as a drum does by its idle torque; what hangs loose for longer is `slack_cable`'s.
Where a cable was let go (LET_GO) it has no lag and is not stretched. The lag is never below 1e-5 s, of which nothing
is seen.

0.5 m of polyamide line of 0.8 mm has some 2 kN/m, of steel rope 100 kN/m; motors that hold a tension by measuring it
take 5 to 50 ms. The arm's cables move at 0.1 m/s, so 1 kN/m and 10 ms change the tension by 1 N.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import EffectParams
from continuum.dynamics.expressions import Numbers, positive_part
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.planar.instant import Instant
from continuum.effects._parts import LEAST_LAG, CableStates, led, lengthening_rate

_TAUT = 0.05  # N: with less a cable is nearly loose


class ElasticCable(CableStates):
    """Springs between motors and arm."""

    name = "elastic_cable"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "lag": Parameter("t_e", "s", 0.0, 1.0, False, "time in which the motor evens out a stretch", 0.0, 0.01),
        "stiffness": Parameter("k", "N/m", 10.0, 1e6, False, "stiffness of a cable", 1e3, 1e3),
    }
    uses_cables = True
    needs_tension = True
    beginnings: ClassVar[Sequence[Mapping[str, float]]] = [
        {"lag": 0.01, "stiffness": 1500.0},
        {"lag": 0.03, "stiffness": 500.0},
        {"lag": 0.08, "stiffness": 170.0},
    ]
    source = "Camarillo et al., IEEE Trans. Robotics 24, 2008, 1262-1273 (tendons); Hogan, ASME JDSMC 107, 1985"
    in_words = "The cables stretch, and the motors take up the stretch only after a while."
    symptom = (
        "While the arm moves fast the tension is above the command where the cable is drawn out, below "
        "it where it is let in."
    )
    experiment = (
        "Hold the arm still and step the command, then hold the command and push the arm; compare the tensions."
    )

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        lag = params["lag"] * led(now.u) + LEAST_LAG
        stretched = params["stiffness"] * led(now.u) * lengthening_rate(now.motion, now.p)
        rising = now.u - state + lag * stretched
        return lag * state_rate - positive_part(rising) + positive_part(-rising) * np.tanh(state / _TAUT)

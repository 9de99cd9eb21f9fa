"""Each cable is a spring between the arm and a yielding motor: T' = k (motor speed + lengthening speed).

The motor winds in at v = alpha (u - T), an admittance with alpha = 1 / (k lag). L is the excess length of the cable's
path through the arm, which the joints change:

  lag T' = r,      r = u - T + lag k L',      times tanh(T / 0.05 N) if r < 0, so that T stays positive.

Without a lag, the motor compensates any stretch immediately and the tension equals the command. Even at zero command
the drum turns only against the resistance 1 / alpha, which acts on an arm that pulls cable out. A cable that becomes
loose is wound up immediately, as by the idle torque of a drum; `slack_cable` describes longer slack. A released cable
(LET_GO) has no lag and is not stretched. The lag is at least 1e-5 s, too little to be observed.

0.5 m of polyamide line of 0.8 mm has about 2 kN/m, steel rope 100 kN/m; motors that control a measured tension take 5
to 50 ms. The cables of the arm move at 0.1 m/s, so 1 kN/m and 10 ms change the tension by 1 N.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import EffectParams
from continuum.dynamics.expressions import Numbers, positive_part
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.planar.instant import Instant
from continuum.effects._parts import LEAST_LAG, CableStates, controlled, lengthening_rate

_TAUT = 0.05  # N; a cable with a lower tension is nearly loose


class ElasticCable(CableStates):
    """Springs between motors and arm."""

    name = "elastic_cable"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "lag": Parameter(
            "t_e", "s", 0.0, 1.0, False, "time constant in which the motor compensates a stretch", 0.0, 0.01
        ),
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
        "While the arm moves fast, the tension exceeds the command in a cable that is drawn out and is below it in a "
        "cable that is taken in."
    )
    experiment = (
        "Hold the arm still and step the command, then hold the command and push the arm; compare the tensions."
    )

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        lag = params["lag"] * controlled(now.u) + LEAST_LAG
        stretched = params["stiffness"] * controlled(now.u) * lengthening_rate(now.motion, now.p)
        rising = now.u - state + lag * stretched
        return lag * state_rate - positive_part(rising) + positive_part(-rising) * np.tanh(state / _TAUT)

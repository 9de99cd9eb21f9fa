"""Motors that follow their commands with a lag: lag T' = u - T for each cable, T the acting tension.

Current-controlled motors follow within 1 to 5 ms, geared servos and drives on a bus within 20 to 100 ms. The lag is at
least 1e-5 s, too little to be observed. A released cable has no lag.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from continuum.dynamics.effect import EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import ByHand, Parameter
from continuum.dynamics.planar.instant import Instant
from continuum.effects._parts import LEAST_LAG, CableStates, controlled


class ActuatorLag(CableStates):
    """A first-order lag of the tensions."""

    name = "actuator_lag"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "lag": Parameter(
            "t_a",
            "s",
            0.0,
            1.0,
            False,
            "time constant of the motors",
            0.0,
            0.03,
            by_hand=ByHand(
                0.005,
                "Hold the arm still, step the command, and record the tension at the base of the cable with a load "
                "cell: the time until it has changed by 63 %.",
            ),
        )
    }
    uses_cables = True
    needs_tension = True
    shifts_time = True
    source = "Franklin, Powell and Emami-Naeini, Feedback Control of Dynamic Systems, ch. 3 (first-order lag)"
    in_words = "The motors follow their commands with a lag."
    symptom = "The arm responds to every change of tension with the same delay; free swings agree with the model."
    experiment = "Step the command with the arm held still and record the tension at the base of the cable."

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        return (params["lag"] * controlled(now.u) + LEAST_LAG) * state_rate - (now.u - state)

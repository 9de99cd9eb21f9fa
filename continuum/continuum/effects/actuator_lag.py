"""Motors that follow their command late: lag T' = u - T, of each cable, T what pulls.

Motors under current control follow within 1 to 5 ms; geared servos and drives over a bus within 20 to 100 ms. The lag
is never below 1e-5 s, of which nothing is seen. A cable that is let go has none.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from continuum.dynamics.effect import EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import ByHand, Parameter
from continuum.dynamics.planar.instant import Instant
from continuum.effects._parts import LEAST_LAG, CableStates, led


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
    symptom = "The arm answers every change of tension late by the same time; free swings agree with the model."
    experiment = "Step the command with the arm held still and record the tension at the base of the cable."

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        return (params["lag"] * led(now.u) + LEAST_LAG) * state_rate - (now.u - state)

"""A cable held at the base with slack: it becomes taut when the arm has taken up the slack.

  T = k y (1 + lambda L')(1 - g),      y = L - slack if positive,      g = u^2 / (u^2 + (0.1 N)^2),

L being the excess length of the cable's path over that through the straight arm: about a theta per joint on the outer
side. The loss is that of Hunt and Crossley with lambda = 4 s/m (a restitution of 0.7 at 0.1 m/s) and acts against
lengthening only. y is rounded within 0.5 mm, the onset of the loss within 5 mm/s. A cable that a motor pulls (g near 1)
is wound up and has no slack. A cable without a command (g near 0) is held. T propagates through the discs like any
other tension.

A total bend of 1 rad draws out 32 mm of cable at a = 32 mm. A soft line of 300 N/m, stretched by 10 mm, pulls with 3 N,
which is 0.1 N m at every joint.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.planar.cable_torque import link_wrenches, serial_jacobian_transposed_times
from continuum.dynamics.planar.capstan_law import tension_propagation
from continuum.dynamics.planar.instant import Instant
from continuum.effects._parts import driven, lengthening, lengthening_rate, rounded_part

_CORNER = 5e-4  # m
_ONSET = 5e-3  # m/s
_LOSS = 4.0  # s/m


class HeldCable(Effect):
    """Cables that stop the arm when it bends far."""

    name = "held_cable"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "stiffness": Parameter("k", "N/m", 0.0, 1e5, False, "stiffness of a held cable", 0.0, 300.0),
        "slack_1": Parameter("s_1", "m", -0.05, 0.5, False, "slack of cable 1 with the arm straight", 0.02, 0.02),
        "slack_2": Parameter("s_2", "m", -0.05, 0.5, False, "slack of cable 2 with the arm straight", 0.02, 0.02),
    }
    uses_cables = True
    source = "Hunt and Crossley, ASME J. Applied Mechanics 42, 1975, 440-445"
    in_words = "A cable that should hang loose goes taut when the arm bends far."
    symptom = "Beyond a certain bend to one side, all joints are held back and thrown back at once."
    experiment = "Take the cables off, or give them more slack, and release again."
    removal = "Take the cables off the arm."

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        """Return -J_s^T W B T, (n,) [N m]. Not in `pull`: tensions have a corner at 0 N, which is T at k = 0."""
        move, p = now.motion, now.p
        local = tension_propagation(move.theta, move.slip_rate, p) * held_tension(now, params)
        return -serial_jacobian_transposed_times(link_wrenches(local, move.theta, p), move.link_angle, p)


def held_tension(now: Instant, params: EffectParams) -> Numbers:
    """T of each cable, (n_cables,) [N]."""
    rate = lengthening_rate(now.motion, now.p)
    slack = np.concatenate([params["slack_1"], params["slack_2"]])
    stretch = rounded_part(lengthening(now.motion, now.p) - slack, _CORNER)
    lengthening_only = rate * (1 + np.tanh(rate / _ONSET)) / 2
    return params["stiffness"] * stretch * (1 + _LOSS * lengthening_only) * (1 - driven(now.u))

"""Drag of the medium on every link: a force c |v| v across the link, v the absolute speed across it at its disc.

On a link without a disc the force acts at its middle. c = (1/2) rho C_d A. |v| is rounded to at least 1 mm/s. A disc
and link of 40 mm x 77 mm with C_d = 1.2 have 0.002 N s^2/m^2 in air, too little to be observed, and 1.8 in water. A
value of 0.3, as of a slack skirt of film or a bundle of loose wires, causes 0.02 N m at the first joint of an arm whose
tip moves at 0.6 m/s.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameter, Parameters
from continuum.dynamics.planar.cable_torque import serial_jacobian_transposed_times
from continuum.dynamics.planar.instant import Instant, Motion
from continuum.effects._parts import across, rounded_size, sum_before

_STILL = 1e-3  # m/s


class QuadraticDrag(Effect):
    """Drag across the links."""

    name = "quadratic_drag"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "drag": Parameter(
            "c", "N s2/m2", 0.0, 50.0, False, "drag of one link divided by the square of its speed", 0.0, 0.3
        )
    }
    source = "Hoerner, Fluid-Dynamic Drag, 1965, ch. 3"
    in_words = "Something brakes the arm as water would, with the square of its speed."
    symptom = "Fast swings, especially of the tip, lose more energy than in the model; slow swings agree."
    experiment = "Release from a large and from a small angle and compare how much of its amplitude each swing keeps."

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        v = speed_across(now.motion, now.p)
        force, none = params["drag"] * rounded_size(v, _STILL) * v, np.zeros(now.p.n_joints)
        return serial_jacobian_transposed_times(np.stack([force, none, none], axis=1), now.motion.link_angle, now.p)


def speed_across(move: Motion, p: Parameters) -> Numbers:
    """Speed across each link of the centre of its disc, or of its middle without a disc, (n,) [m/s]."""
    side = across(move.link_angle)
    before = sum_before((p.joint_spacing * move.link_rate)[:, None] * side)
    return (side * before).sum(axis=1) + p.middle * move.link_rate

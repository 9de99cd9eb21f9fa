"""The sensors' charging cable, from the base to link 1: preload + k theta_1 + c w_1 + tau tanh(k_v w_1) on joint 1.

A bent cable is a spring, and its strands and sheath rub. A USB cable of EI = 2e-3 N m^2 in a loop of 50 mm has
0.04 N m/rad; bundles and stiff sheaths a few times that. Bent by 0.5 rad in the straight arm, that preloads the joint
by 0.02 N m.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import Effect, Own
from continuum.dynamics.expressions import Numbers, smooth_sign
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.planar.instant import Instant


class SensorCable(Effect):
    """Stiffness and drag of a cable across joint 1."""

    name = "sensor_cable"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "preload": Parameter("tau_0", "N m", -1.0, 1.0, False, "torque of the cable in the straight arm", 0.0, 0.02),
        "stiffness": Parameter("k", "N m/rad", 0.0, 100.0, False, "stiffness of the cable at joint 1", 0.0, 0.1),
        "viscous": Parameter("c", "N m s/rad", 0.0, 10.0, False, "viscous drag of the cable", 0.0, 0.01),
        "dry": Parameter("tau", "N m", 0.0, 10.0, False, "dry friction in the cable", 0.0, 0.02),
    }
    source = "Papailiou, IEEE Trans. Power Delivery 12, 1997 (bending stiffness and friction of cables)"
    in_words = "The charging cable of the sensors holds back the first joint."
    looks_like = "Joint 1 alone is stiffer, damped more and drawn to one side."
    experiment = "Take the charging cable off, or tie it elsewhere, and release again."

    def torque(self, now: Instant, own: Own, state: Numbers) -> Numbers:
        theta, w = now.motion.theta[:1], now.motion.theta_rate[:1]
        bent = own["preload"] + own["stiffness"] * theta
        rubbing = own["viscous"] * w + own["dry"] * smooth_sign(w, now.p.friction_slope)
        return np.concatenate([bent + rubbing, np.zeros(now.p.n_joints - 1)])

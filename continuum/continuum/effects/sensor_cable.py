"""The charging cable of the sensors, from the base to link 1, resists being drawn out by joint 1.

  r (tau_0 + k s + c s' + tau tanh(k_v s')) on joint 1,      s = theta_1 + e theta_1^2 / 2,      r = 1 + e theta_1.

s is the length drawn out, in units of the lever in the straight arm, and r = ds / dtheta_1 is the lever: by virtual
work, a force acts with the lever by which it is drawn out. A loop around the joint has e = 0. A cable drawn straight
from a clamp pulls along its line, and its lever changes as the link turns: e = h / d for a cable that is fixed to link
1 at h from the axis of the arm and d beyond the joint, and drawn out across the arm. At a zero lever the cable exerts
no torque.

A bent cable is a spring, and its strands and sheath have friction. A USB cable of EI = 2e-3 N m^2 in a loop of 50 mm
has 0.04 N m/rad; bundles and stiff sheaths have several times that. If it is bent by 0.5 rad in the straight arm, the
preload of the joint is 0.02 N m.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers, smooth_sign
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.planar.instant import Instant


class SensorCable(Effect):
    """Stiffness and friction of a cable across joint 1."""

    name = "sensor_cable"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "preload": Parameter("tau_0", "N m", -1.0, 1.0, False, "torque of the cable in the straight arm", 0.0, 0.02),
        "stiffness": Parameter("k", "N m/rad", 0.0, 100.0, False, "stiffness of the cable at joint 1", 0.0, 0.1),
        "viscous": Parameter("c", "N m s/rad", 0.0, 10.0, False, "viscous drag of the cable", 0.0, 0.01),
        "dry": Parameter("tau", "N m", 0.0, 10.0, False, "dry friction in the cable", 0.0, 0.02),
        "lever": Parameter(
            "e", "1/rad", -20.0, 20.0, False, "relative increase of the lever with the angle", 0.0, 2.0, shape=True
        ),
    }
    source = "Papailiou, IEEE Trans. Power Delivery 12, 1997 (bending stiffness and friction of cables)"
    in_words = "The charging cable of the sensors pulls on the first joint."
    symptom = "Joint 1 alone is stiffer, more damped and drawn to one side."
    experiment = "Take the charging cable off, or tie it elsewhere, and release again."
    removal = "Take the charging cable off."
    beware = "Anything else that pushes or rubs on the first joint looks nearly the same, such as a pad it leans on."

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        theta, w = now.motion.theta[:1], now.motion.theta_rate[:1]
        way, lever = theta + params["lever"] * theta**2 / 2, 1 + params["lever"] * theta
        drawn = lever * w
        force = params["preload"] + params["stiffness"] * way + params["viscous"] * drawn
        rubbing = params["dry"] * smooth_sign(lever * now.motion.slip_rate[:1], now.p.friction_slope)
        return np.concatenate([lever * (force + rubbing), np.zeros(now.p.n_joints - 1)])

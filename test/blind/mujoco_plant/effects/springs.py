"""Springs of the joints that differ from equal linear ones at rest in the straight arm."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.parameters import Parameters

if TYPE_CHECKING:
    from blind.mujoco_plant.machine import Machine


class RestAngle(Effect):
    """The spring of one joint is at rest at the angle theta_0 [rad]: torque -K (theta - theta_0)."""

    name, unit, sizes, signed, at_a_joint = "rest_angle", "rad", (0.026, 0.061, 0.122), True, True

    def change(self, p: Parameters) -> Parameters:
        rest = p.rest_angle.copy()
        rest[self.joint - 1] += self.amount
        return p.with_(rest_angle=rest)


class JointStiffness(Effect):
    """One joint's spring is stiffer or softer: K (1 + s), s without unit."""

    name, unit, sizes, signed, at_a_joint = "joint_stiffness", "1", (0.12, 0.30, 0.55), True, True

    def change(self, p: Parameters) -> Parameters:
        return p.scaled("stiffness", self.joint, 1 + self.amount)


class HardeningSpring(Effect):
    """Every spring hardens like a hyperbolic sine: -K theta_h sinh(theta / theta_h), theta_h = 1 / sqrt(6 c).

    The amount is c [1/rad^2], the cubic term's share: -K (theta + c theta^3 + 0.3 c^2 theta^5 + ...).
    """

    name, unit, sizes = "hardening_spring", "1/rad^2", (0.8, 2.4, 6.0)

    def act(self, machine: "Machine") -> Callable[[], None]:
        p, hinge, scale = machine.p, machine.hinge, 1 / np.sqrt(6 * self.amount)

        def harden() -> None:
            bent = machine.data.qpos[hinge] - p.rest_angle
            machine.torque[hinge] -= p.stiffness * (scale * np.sinh(bent / scale) - bent)

        return harden

"""Dry friction of the joints that is not equal everywhere or not constant."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.parameters import JOINTS, Parameters

if TYPE_CHECKING:
    from blind.mujoco_plant.machine import Machine


class JointFriction(Effect):
    """One joint rubs more: its tau_c and its tau_mu are (1 + s) times the others'; s without unit."""

    name, unit, sizes, at_a_joint = "joint_friction", "1", (0.6, 1.5, 4.0), True

    def change(self, p: Parameters) -> Parameters:
        return p.scaled("coulomb", self.joint, 1 + self.amount).scaled("viscous", self.joint, 1 + self.amount)


class LoadFriction(Effect):
    """Dry friction of every joint grows with the force that the ball carries: tau_c + r |F|.

    F [N] is the reaction between the two links from the engine's inverse dynamics, with weight, acceleration and the
    cables' pull across the joint, each once. The amount is r [m], coefficient of friction times the ball's radius.
    Stribeck acts on tau_c alone.
    """

    name, unit, sizes = "load_friction", "m", (0.3e-3, 1e-3, 3e-3)

    def act(self, machine: "Machine") -> Callable[[], None]:
        model, data = machine.model, machine.data
        bodies = model.jnt_bodyid[
            [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, f"joint_{i + 1}") for i in range(JOINTS)]
        ]

        def grow() -> None:
            mujoco.mj_rnePostConstraint(model, data)
            carried = data.cfrc_int[bodies, 3:]  # by the joints alone, the engine knows the cables (5, 3)
            machine.coulomb += self.amount * np.linalg.norm(carried, axis=-1)

        return grow

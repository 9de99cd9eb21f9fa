"""The base plate: askew, or giving way."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from blind.mujoco_plant.chain import PLATE_INERTIA, Chain
from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.effects.sensors import about
from blind.mujoco_plant.parameters import Parameters

if TYPE_CHECKING:
    from blind.mujoco_plant.machine import Machine

DAMPING_RATIO = 0.05
CARRIED = 0.013  # inertia of plate and hanging arm about the base [kg m^2], for the damping only


class BaseTilt(Effect):
    """The base plate is turned by beta [rad] as a joint before the first would turn it.

    Joint angles are still from plate to link. Gravity in the plate's frame is g (-sin beta, -cos beta) along (cable
    1's side, up).
    """

    name, unit, sizes, signed = "base_tilt", "rad", (0.0175, 0.052, 0.105), True

    def change(self, p: Parameters) -> Parameters:
        return p.with_(base_tilt=p.base_tilt + self.amount)


class RemountedBase(Effect):
    """The base plate is clamped again for every recording, each time turned by another angle.

    The angles are of either sign, with magnitudes between half and one and a half times the amount [rad]; gravity
    turns against the plate, which itself stays. Joint angles are from plate to link.
    """

    name, unit, sizes = "remounted_base", "rad", (0.0175, 0.052, 0.105)

    def act(self, machine: "Machine") -> Callable[[], None] | None:
        (turned,) = about(self.amount, machine.rng, 1)
        across, up = machine.plumb[0], machine.plumb[2]
        turn = np.array([across * np.cos(turned) + up * np.sin(turned), up * np.cos(turned) - across * np.sin(turned)])
        machine.plumb[[0, 2]] = machine.model.opt.gravity[[0, 2]] = turn
        return None


class BaseCompliance(Effect):
    """The bracket bends: the plate turns on a hinge of its own with a spring and slight damping.

    The amount is the spring's compliance 1/K [rad/(N m)]; plate 0.4 kg, 5e-4 kg m^2; damping ratio 0.05. The cables'
    base ends turn with the plate. The sensors see the plate's turning within the first joint's angle, since none sits
    on the plate.
    """

    name, unit, sizes = "base_compliance", "rad/(N m)", (0.02, 0.06, 0.15)

    def build(self, chain: Chain) -> None:
        if self.amount:
            stiffness = 1 / self.amount
            damping = 2 * DAMPING_RATIO * float(np.sqrt(stiffness * (CARRIED + PLATE_INERTIA)))
            chain.base_hinge = (stiffness, damping)

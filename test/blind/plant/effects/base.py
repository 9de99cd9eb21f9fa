"""The base plate: askew, or giving way."""

import numpy as np

from blind.plant.chain import PLATE_INERTIA, Chain
from blind.plant.effect import Effect
from blind.plant.parameters import Parameters

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

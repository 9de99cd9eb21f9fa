"""Clearance of a joint."""

from blind.mujoco_plant.chain import Chain
from blind.mujoco_plant.effect import Effect

FINER = 8  # steps: light as it is, the ball may not fly off a stop that it is pressed to within one


class Backlash(Effect):
    """One joint has play: a second hinge in series, free within +-c [rad] between hard stops.

    Spring and friction are between the upper link and the ball, the play between the ball (with its ring 30 g of the
    link) and the lower link. The measured angle is that of both.
    """

    name, unit, sizes, at_a_joint = "backlash", "rad", (0.006, 0.018, 0.045), True

    def build(self, chain: Chain) -> None:
        if self.amount:
            chain.play[self.joint] = self.amount
            chain.finer = FINER

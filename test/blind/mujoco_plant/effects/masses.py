"""Masses that differ from those on paper."""

from blind.mujoco_plant.chain import Chain
from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.parameters import JOINTS, Parameters


class Inertia(Effect):
    """All links are heavier than on paper by the share s and, with the mass sitting far out, their inertia by 2 s.

    m (1 + s), I_z (1 + 2 s) about the centre of mass; s without unit.
    """

    name, unit, sizes = "inertia", "1", (0.10, 0.25, 0.50)

    def change(self, p: Parameters) -> Parameters:
        return p.scaled("mass", None, 1 + self.amount).scaled("inertia", None, 1 + 2 * self.amount)


class TipPayload(Effect):
    """A point mass [kg] on the tip disc, b beyond the last joint."""

    name, unit, sizes = "tip_payload", "kg", (0.02, 0.06, 0.15)

    def build(self, chain: Chain) -> None:
        if self.amount:
            chain.loads["load"] = (JOINTS, chain.p.half_spacing, self.amount)

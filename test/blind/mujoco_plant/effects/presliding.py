"""Joints that give a little before they slip."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.parameters import JOINTS

if TYPE_CHECKING:
    from blind.mujoco_plant.machine import Machine

ELEMENTS = 10


class Presliding(Effect):
    """Dry friction as Jenkins elements in parallel (Iwan's model): equal springs that slip one after another.

    Element j of 10 holds f_j = clip(f_j + k dtheta, +-k x_j (1 + S exp(..))), with x_j spread evenly from 0.1 to 1.9
    times the amount x_s [rad], and k such that all together slip at the joint's dry friction, Stribeck's share and what
    other effects add to it included. The springs are the same at any speed: ones that stiffened where a joint slows
    down would give back more than they took. The engine's own friction is off.
    """

    name, unit, sizes = "presliding", "rad", (0.0023, 0.007, 0.02)

    def act(self, machine: "Machine") -> Callable[[], None]:
        hinge = machine.hinge
        share = np.linspace(0.1, 1.9, ELEMENTS) / ELEMENTS  # of the friction that each element holds; sums up to 1
        force = np.zeros((JOINTS, ELEMENTS))
        before = machine.data.qpos[hinge].copy()
        stiffness = machine.p.coulomb / (self.amount * ELEMENTS)

        def slip() -> None:
            nonlocal force, before
            now = machine.data.qpos[hinge].copy()
            limit = machine.coulomb[:, None] * share
            force = np.clip(force + (stiffness * (now - before))[:, None], -limit, limit)
            before = now
            machine.torque[hinge] -= force.sum(axis=1)
            machine.coulomb[:] = 0.0

        return slip

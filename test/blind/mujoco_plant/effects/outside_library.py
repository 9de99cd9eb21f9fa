"""Effects that no library of effects holds: the right answer to them is that something unknown is at work."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import mujoco
import numpy as np

from blind.mujoco_plant.chain import Chain
from blind.mujoco_plant.effect import ONLY_DRIVEN, Effect
from blind.mujoco_plant.parameters import JOINTS

if TYPE_CHECKING:
    from blind.mujoco_plant.machine import Machine


class Magnet(Effect):
    """A magnet on one disc catches the next one at an angle theta_m of 9 degrees.

    Torque -A x exp((1 - x^2) / 2), x = (theta - theta_m) / w, w = 3 degrees: at most A [N m], the amount, and next to
    nothing some 10 degrees away.
    """

    name, unit, sizes, at_a_joint, in_a_library = "magnet", "N m", (0.05, 0.12, 0.3), True, False

    centre, width = np.radians(9.0), np.radians(3.0)

    def act(self, machine: "Machine") -> Callable[[], None]:
        def attract() -> None:
            x = (machine.angle[self.joint - 1] - self.centre) / self.width
            machine.push(self.joint, -self.amount * x * np.exp(0.5 * (1 - x * x)))

        return attract


class RubbingDisc(Effect):
    """A disc's edge rubs on its neighbour past 3 degrees: dry friction A d, elastic push 0.5 A d, d the angle beyond.

    The amount is A [N m/rad].
    """

    name, unit, sizes, at_a_joint, in_a_library = "rubbing_disc", "N m/rad", (0.5, 1.5, 5.0), True, False

    edge = np.radians(3.0)

    def act(self, machine: "Machine") -> Callable[[], None]:
        def rub() -> None:
            beyond = machine.angle[self.joint - 1] - self.edge
            if beyond > 0:
                machine.coulomb[self.joint - 1] += self.amount * beyond
                machine.push(self.joint, -0.5 * self.amount * beyond)

        return rub


class DroppingLoad(Effect):
    """A load [kg] on the tip disc falls off between a quarter and half of each recording's time."""

    name, unit, sizes, in_a_library = "dropping_load", "kg", (0.04, 0.1, 0.25), False

    def build(self, chain: Chain) -> None:
        if self.amount:
            chain.loads["load"] = (JOINTS, chain.p.half_spacing, self.amount)

    def act(self, machine: "Machine") -> Callable[[], None]:
        at = machine.duration * machine.rng.uniform(0.25, 0.5)
        body = mujoco.mj_name2id(machine.model, mujoco.mjtObj.mjOBJ_BODY, "load")

        def fall() -> None:
            if machine.time >= at:
                machine.model.body_mass[body] = machine.model.body_inertia[body] = 0.0

        return fall


class KinkedSpring(Effect):
    """One joint's spring kinks: bent by more than 10 degrees it snaps and loses a share of its torque.

    It snaps back below 4 degrees. The amount is the share, without unit. After a release friction may hold the joint
    beyond these 4 degrees to the end: then it is a soft joint, `joint_stiffness`, and nothing else in any data.
    """

    name, unit, sizes, at_a_joint, in_a_library = "kinked_spring", "1", (0.2, 0.45, 0.8), True, False
    seen_in = ONLY_DRIVEN

    over, back = np.radians(10.0), np.radians(4.0)

    def act(self, machine: "Machine") -> Callable[[], None]:
        at, kinked = machine.hinge[self.joint - 1], False
        stiffness = machine.p.stiffness[self.joint - 1]

        def snap() -> None:
            nonlocal kinked
            angle = machine.data.qpos[at]
            kinked = abs(angle) > (self.back if kinked else self.over)
            if kinked:
                machine.torque[at] += self.amount * stiffness * angle

        return snap


class ShakenBase(Effect):
    """A machine nearby shakes the bracket sideways: A sin(2 pi f t), 4 to 7 Hz. The amount is A [m/s^2]."""

    name, unit, sizes, in_a_library = "shaken_base", "m/s^2", (0.4, 1.2, 3.0), False

    def act(self, machine: "Machine") -> Callable[[], None]:
        frequency, phase = 2 * np.pi * machine.rng.uniform(4, 7), machine.rng.uniform(0, 2 * np.pi)

        def shake() -> None:
            machine.model.opt.gravity[0] = machine.plumb[0] - self.amount * np.sin(frequency * machine.time + phase)

        return shake

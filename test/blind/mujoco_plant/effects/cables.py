"""What lies between the tension commanded and the one that bends the arm; a cable that is let go shows none of it."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from blind.mujoco_plant.effect import ONLY_DRIVEN, Effect
from blind.mujoco_plant.parameters import Parameters

if TYPE_CHECKING:
    from blind.mujoco_plant.machine import Machine

Pull = Callable[[np.ndarray], np.ndarray]


class Capstan(Effect):
    """The cables rub more at the discs than on paper: mu_c + s, both without unit."""

    name, unit, sizes, seen_in = "capstan", "1", (0.06, 0.18, 0.45), ONLY_DRIVEN

    def change(self, p: Parameters) -> Parameters:
        return p.with_(cable_friction=p.cable_friction + self.amount)


class ElasticCable(Effect):
    """The command drives a winch against its friction, and the winch pulls through an elastic cable.

    Reeled-in cable x [m]: d x' = u - T, T = max(0, x + l(theta) - l_0) / c, with d = 12 N s/m; a slack cable is
    reeled in as it is. The amount is the compliance c [m/N], with all that gives way between winch and tip: 2e-3 is a
    cable that stretches by 20 mm under 10 N. The smallest c do not approach the arm without the effect, but a winch
    with friction.
    """

    name, unit, sizes, seen_in = "elastic_cable", "m/N", (6e-4, 2e-3, 6e-3), ONLY_DRIVEN

    winch_friction = 12.0  # d [N s/m]

    def pull(self, machine: "Machine") -> Pull:
        start = machine.cable_length()
        before, reeled = start, np.zeros(2)
        keep = float(np.exp(-machine.dt / (self.amount * self.winch_friction)))

        def through_the_cable(command: np.ndarray) -> np.ndarray:
            nonlocal before, reeled
            now = machine.cable_length()
            reeled = np.maximum(reeled, start - now)
            tension = (reeled + now - start) / self.amount
            balanced = self.amount * command + start - (1.5 * now - 0.5 * before)  # at the step's middle
            reeled = balanced + keep * (reeled - balanced)
            before = now
            return tension

        return through_the_cable


class SlackCable(Effect):
    """Each cable sags when it is not pulled, and pulls only when its winch has reeled in the sag.

    The sag g [m] of a cable obeys g' = -l'(theta) - v while u > 1 N and g' = -l'(theta) + v otherwise, within 0 <= g
    <= s_0, with the winch's speed v = 0.3 m/s; it pulls with u max(0, 1 - g / 1 mm). The amount is s_0 [m].
    """

    name, unit, sizes, seen_in = "slack_cable", "m", (3e-3, 8e-3, 20e-3), ONLY_DRIVEN

    speed, threshold, taut_within = 0.3, 1.0, 1e-3

    def pull(self, machine: "Machine") -> Pull:
        dt, before, sag = machine.dt, machine.cable_length().copy(), np.full(2, self.amount)
        reel = np.full(2, self.speed)

        def after_the_sag(command: np.ndarray) -> np.ndarray:
            nonlocal before, sag, reel
            now = machine.cable_length().copy()
            sag = np.clip(sag + dt * reel - (now - before), 0.0, self.amount)
            reel = np.where(command > self.threshold, -self.speed, self.speed)  # from now on
            before = now
            return command * np.maximum(0.0, 1 - sag / self.taut_within)

        return after_the_sag


class ActuatorLag(Effect):
    """The tension follows the command as a first-order lag: tau T' = u - T. The amount is tau [s]."""

    name, unit, sizes, seen_in = "actuator_lag", "s", (0.015, 0.04, 0.1), ONLY_DRIVEN

    def pull(self, machine: "Machine") -> Pull:
        tension = np.zeros(2)
        keep = float(np.exp(-machine.dt / self.amount))

        def late(command: np.ndarray) -> np.ndarray:
            nonlocal tension
            now, tension = tension, command + keep * (tension - command)
            return now

        return late


class TensionScale(Effect):
    """Load cells show cable 1's tension as (1 + s) times what it is, and cable 2's as (1 + s / 2) times.

    Rows hold what they show; s without unit.
    """

    name, unit, sizes, signed, seen_in = "tension_scale", "1", (0.04, 0.12, 0.25), True, ONLY_DRIVEN

    def pull(self, machine: "Machine") -> Pull:
        shown = np.array([1 + self.amount, 1 + self.amount / 2])
        return lambda command: command / shown

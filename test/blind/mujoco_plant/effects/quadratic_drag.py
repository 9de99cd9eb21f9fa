"""Drag of the surrounding medium."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.parameters import JOINTS

if TYPE_CHECKING:
    from blind.mujoco_plant.machine import Machine

NODES, WEIGHTS = np.polynomial.legendre.leggauss(4)


class QuadraticDrag(Effect):
    """Drag grows with the square of the speed across the arm: -c v_n |v_n| per length, integrated along each link.

    v_n [m/s] is the speed across the link at each of four Gauss points between its joint and the next. The amount is
    c [kg/m^2 = N s^2/m^3], half of density times drag coefficient times width: 0.05 for the discs in air, 10 for a
    sail of 0.3 m in air that wraps the arm, 40 for the discs in water.
    """

    name, unit, sizes = "quadratic_drag", "kg/m^2", (1.5, 5.0, 15.0)

    def act(self, machine: "Machine") -> Callable[[], None]:
        length = 2 * machine.p.half_spacing
        along, weight = 0.5 * length * (NODES + 1), 0.5 * length * WEIGHTS * self.amount
        lower = np.tril(np.ones((JOINTS, JOINTS)), -1)

        def drag() -> None:
            angle, rate = np.cumsum(machine.angle), np.cumsum(machine.rate)
            turned = angle[:, None] - angle
            # across link i, its joint moves by the sum of l cos(Theta_i - Theta_k) Theta_k' over links k before
            lever = length * lower * np.cos(turned)
            across = (lever @ rate)[:, None] + rate[:, None] * along
            force = -weight * across * np.abs(across)
            total, moment = force.sum(axis=1), force @ along
            machine.torque += machine.joints.T @ np.cumsum((lever.T @ total + moment)[::-1])[::-1]

        return drag

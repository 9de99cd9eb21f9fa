"""Faults of the sensors: what moves is as it should be, what is read is not."""

from typing import TYPE_CHECKING

import numpy as np

from blind.mujoco_plant.effect import Effect

if TYPE_CHECKING:
    from blind.mujoco_plant.sensors import Reading


def about(amount: float, rng: np.random.Generator, count: int) -> np.ndarray:
    """Values of either sign, between half and one and a half times the amount."""
    values: np.ndarray = amount * rng.choice([-1.0, 1.0], count) * rng.uniform(0.5, 1.5, count)
    return values


class AngleOffset(Effect):
    """The zero of each joint's angle is wrong, differently in each recording: theta_i + o_i.

    The o_i are of either sign, with magnitudes between half and one and a half times the amount [rad].
    """

    name, unit, sizes = "angle_offset", "rad", (0.012, 0.035, 0.09)

    def sense(self, reading: "Reading", rng: np.random.Generator) -> None:
        reading.joint_offset += about(self.amount, rng, reading.sensors)


class GyroDrift(Effect):
    """Each gyro has a bias, another one in each recording: link rate + b_i, link angle + b_i t.

    Joints are differences of links, so joint i drifts by b_i - b_i-1. The b_i are of either sign, with magnitudes
    between half and one and a half times the amount [rad/s].
    """

    name, unit, sizes = "gyro_drift", "rad/s", (0.007, 0.02, 0.055)

    def sense(self, reading: "Reading", rng: np.random.Generator) -> None:
        reading.bias += about(self.amount, rng, reading.sensors)


class SensorDelay(Effect):
    """All sensors, but not the tensions, are stamped late: rows hold angles and rates of t - d. The amount is d [s]."""

    name, unit, sizes = "sensor_delay", "s", (0.006, 0.018, 0.045)

    def sense(self, reading: "Reading", rng: np.random.Generator) -> None:
        reading.delay += self.amount


class SensorScale(Effect):
    """The sensor of one link has a wrong gain: (1 + s) times the link's angle and rate, s without unit.

    A sensor whose axis stands off the joints' axis by 20 degrees reads s = cos(20 deg) - 1 = -0.06. Joint i is read as
    theta_i + s Theta_i, the next one as theta_i+1 - s Theta_i, with Theta_i the sum of the joints up to i.
    """

    name, unit, sizes, signed, at_a_joint = "sensor_scale", "1", (0.03, 0.08, 0.2), True, True

    def sense(self, reading: "Reading", rng: np.random.Generator) -> None:
        reading.gain[self.joint - 1] *= 1 + self.amount

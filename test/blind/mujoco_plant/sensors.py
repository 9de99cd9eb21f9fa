"""The sensors: a gyro on every link, its angle integrated, neighbours subtracted, 120 rows a second."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.machine import RATE, Motion


@dataclass(frozen=True)
class Noise:
    """Errors of each link's sensor that every recording has; standard deviations.

    A link's angle is the integral of its measured rate, so the gyro's white noise lets it wander; a white error comes
    on top. A joint's angle is the difference of two links', so its errors are correlated with its neighbours'.

    Attributes:
        gyro: white noise of the rate [rad/s].
        bias: what is left of the gyro's bias after its correction, constant in a recording [rad/s].
        angle: white noise of the angle [rad].
        start: error of the angle at the first row [rad].
    """

    gyro: float = 0.0
    bias: float = 0.0
    angle: float = 0.0
    start: float = 0.0

    def times(self, factor: float) -> "Noise":
        return Noise(factor * self.gyro, factor * self.bias, factor * self.angle, factor * self.start)

    def joint_angle(self) -> float:
        """Standard deviation of a joint's angle in a row, without wandering [rad]."""
        return float(np.sqrt(2) * np.hypot(self.angle, self.start))


# 0.17 degrees of white noise in a joint's angle, wandering by 0.1 degrees in 1.6 s
ORDINARY = Noise(gyro=np.radians(0.6), bias=np.radians(0.02), angle=np.radians(0.12), start=np.radians(0.05))
NOISES = {"none": Noise(), "low": ORDINARY.times(0.4), "ordinary": ORDINARY, "high": ORDINARY.times(2.0)}


class Reading:
    """How the sensors of one recording read; effects change it.

    Attributes:
        sensors: their number.
        gain: of each link's sensor (5,).
        bias: of each link's gyro (5,) [rad/s].
        joint_offset: of each joint's angle (5,) [rad].
        delay: of all rows [s].
    """

    def __init__(self, sensors: int, effects: Sequence[Effect], rng: np.random.Generator) -> None:
        self.sensors = sensors
        self.gain = np.ones(sensors)
        self.bias = np.zeros(sensors)
        self.joint_offset = np.zeros(sensors)
        self.delay = 0.0
        for effect in effects:
            if effect.amount:
                effect.sense(self, rng)

    def take(self, motion: Motion, noise: Noise, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        """Joint angles [rad] and rates [rad/s] as read, each (rows, 5)."""
        time = np.arange(motion.rows) / RATE
        shape = (motion.rows, self.sensors)
        gyro_noise = noise.gyro * rng.standard_normal(shape)
        bias = self.bias + noise.bias * rng.standard_normal(self.sensors)
        angle_noise = noise.angle * rng.standard_normal(shape) + noise.start * rng.standard_normal(self.sensors)
        wandering = np.vstack([np.zeros(self.sensors), np.cumsum(gyro_noise[1:], axis=0)]) / RATE
        rate = self.gain * at(motion, motion.rate, time - self.delay) + bias + gyro_noise
        angle = self.gain * at(motion, motion.angle, time - self.delay) + bias * time[:, None] + wandering + angle_noise
        return between(angle) + self.joint_offset, between(rate)


def between(links: np.ndarray) -> np.ndarray:
    """Joints (n, 5) from links (n, 5): each less the one above it."""
    return np.diff(links, axis=1, prepend=0.0)


def at(motion: Motion, values: np.ndarray, time: np.ndarray) -> np.ndarray:
    """``values`` (n, 5) of the motion's instants at other times, held before the first: (m, 5)."""
    return np.column_stack([np.interp(time, motion.time, column) for column in values.T])

"""The emulated bench without port and clock: arm, actuators, sensors and controller, advanced tick by tick."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from continuum.dynamics.live.live_arm import LiveArm
from continuum.dynamics.live.stepper import Interval
from continuum.dynamics.model import Model
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.dynamics.trajectory import SimulationStatus
from continuum.errors import InvalidValueError
from continuum_hw_imu.emulator.actuators import Actuators
from continuum_hw_imu.emulator.hand import Hand
from continuum_hw_imu.emulator.link_motion import LinkMotion, effective, gravity, half_spacing, link_motion
from continuum_hw_imu.emulator.sensor_model import SensorModel
from continuum_hw_imu.protocol.messages import FaultCode, Hello, ImuFrame, Message, ReceiverLimits, SensorPlace
from continuum_hw_imu.protocol.messages.imu import MOST_SENSORS
from continuum_hw_imu.receiver.bench_controller import BenchController
from continuum_hw_imu.sensor_quality import SensorQuality

FIRMWARE = "bench_emulator 0.1.0"
LOW_BATTERY = 15
"""[%]"""

_TICKS = 240.0
"""Smallest rate at which the arm is advanced [Hz]."""


@dataclass(frozen=True)
class BenchSettings:
    """Settings of a bench.

    Attributes:
        sample_rate: sample rate of the sensors [Hz].
        bend: total bend of the arm at the start, distributed equally over the joints [rad].
        limits: limits of the receiver.
        quality: quality of the sensors.
        actuator_lag: time constant of the tensions [s].
        tension_noise: standard deviation of the load cells [N].
        seed: seed of all random numbers.
    """

    sample_rate: float = 60.0
    bend: float = 0.0
    limits: ReceiverLimits = field(default_factory=ReceiverLimits)
    quality: SensorQuality = field(default_factory=SensorQuality)
    actuator_lag: float = 0.03
    tension_noise: float = 0.05
    seed: int = 0


class Bench:
    """An emulated bench. Its construction compiles the model's equations, which may take seconds.

    Args:
        model: model of the arm.
        settings: all other settings.

    Attributes:
        controller: the bench controller, the device's side of the protocol.
        sensors, actuators, arm: parts of the bench.
        hand: hand that holds the arm, if any.
        deaf: whether bytes from the host are ignored.
        mute: whether no frames of the sensors are sent, as if their task hung.
        failed: reason why the simulation of the arm failed; None while it runs.

    Raises:
        InvalidValueError: the arm has more joints than the protocol has sensors, or cannot move from its posture.
        CompilerError: the equations cannot be compiled.
    """

    def __init__(self, model: Model, settings: BenchSettings) -> None:
        model.require_cables("the bench")
        n = model.n_joints
        if n > MOST_SENSORS:
            raise InvalidValueError("n_joints", n, f"at most {MOST_SENSORS}, each with a sensor")
        self._settings = settings
        self._random = np.random.default_rng(settings.seed)
        self._fall, self._half_spacing = gravity(model), half_spacing(model)
        self.arm = LiveArm(model, np.full(n, settings.bend / n), "esdirk")
        self.sensors = SensorModel(n, settings.quality, self._random)
        self.ticks_per_sample = max(1, round(_TICKS / settings.sample_rate))
        self.tick_rate = settings.sample_rate * self.ticks_per_sample
        self.hand: Hand | None = None
        self.deaf = False
        self.mute = False
        self.failed: SimulationStatus | None = None
        self._sample = 0
        self._ticks = 0
        self._forces = np.zeros((n, 3))
        self._angles = np.cumsum(self.arm.angles)
        self.boot()

    @property
    def n_joints(self) -> int:
        return self.sensors.n

    def check_sensor(self, number: int) -> None:
        """Check the number of a sensor, from 1.

        Raises:
            InvalidValueError: no sensor has this number.
        """
        if not 1 <= number <= self.n_joints:
            raise InvalidValueError("sensor", number, f"1 to {self.n_joints}")

    def boot(self) -> None:
        """Restart the controller with slack cables and without a commander. The arm continues to move."""
        n, settings = self.n_joints, self._settings
        places = tuple(SensorPlace(i + 1, f"DOT-{i + 1}") for i in range(n))
        boot = int(np.random.default_rng().integers(1 << 32))  # independent of the seed: two starts must differ
        hello = Hello(boot, FIRMWARE, settings.sample_rate, places, len(SIDES), settings.limits)
        self.controller = BenchController(hello)
        self.controller.batteries = [90] * n
        self.actuators = Actuators(len(SIDES), settings.actuator_lag, settings.tension_noise, self._random)

    def hear(self, data: bytes, now: int) -> list[Message]:
        """Process bytes from the host at a device time [us], and return the answers."""
        return [] if self.deaf else self.controller.hear(data, now)

    def tick(self, begin: int, duration: float, real: float) -> list[Message]:
        """Advance from device time ``begin`` [us] by a ``duration`` [s], and return the messages for the end of it.

        ``real`` is the time of the end [s] on the clock that `Hand` uses.
        """
        pull = self.actuators.follow(self.controller.move_on(begin, duration))
        before = self._motion()
        self._move_arm(pull, real)
        after = self._motion()
        self._forces += effective(before, after, duration, self._fall)
        self._ticks += 1
        self._watch()
        return self._sampled(duration) if self._ticks == self.ticks_per_sample else []

    def _motion(self) -> LinkMotion:
        return link_motion(self.arm.angles, self.arm.rates, self._half_spacing)

    def _move_arm(self, pull: Interval, real: float) -> None:
        if self.hand is not None:
            theta, rate = self.hand.motion(real)
            self.arm.place(np.concatenate([theta, rate, self.arm.state[2 * self.n_joints :]]))
            if real >= self.hand.end:
                self.hand = None
            return
        status = self.arm.advance(pull)
        if status is not SimulationStatus.COMPLETE:
            self.failed = status
            self.arm.place(self.arm.angles)

    def _watch(self) -> None:
        """Report faults of the sensors to the controller."""
        faults = self.controller.faults
        for i, charge in enumerate(self.controller.batteries):
            faults.put(i in self.sensors.lost, FaultCode.SENSOR_LOST, i + 1)
            faults.put(charge is not None and charge < LOW_BATTERY, FaultCode.BATTERY_LOW, i + 1)

    def _sampled(self, duration: float) -> list[Message]:
        period = duration * self.ticks_per_sample
        angles = np.cumsum(self.arm.angles)
        frame: ImuFrame = self.sensors.frame(
            self._sample, (angles - self._angles) / period, self._forces / self.ticks_per_sample, period
        )
        self._sample += 1
        self._ticks, self._forces, self._angles = 0, np.zeros((self.n_joints, 3)), angles
        tension = self.controller.tension_frame(self.actuators.measured().tolist())
        return [tension] if self.mute else [frame, tension]

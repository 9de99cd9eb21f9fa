"""From frames of the sensors to joint angles, and the latest seconds of samples for whoever calibrates."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable

import numpy as np

from continuum.errors import MeasurementError
from continuum.inertial.angle_estimator import AngleEstimate, AngleEstimator
from continuum.inertial.calibration_steps import CalibrationSteps
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.imu_sample import ImuSample
from continuum_hw_imu.link.received import Received
from continuum_hw_imu.protocol.device_time import MICROSECONDS
from continuum_hw_imu.protocol.messages import Hello, ImuFrame

KEPT = 60.0
"""Samples of so many seconds are kept."""


class SensorWatch:
    """Of one arm's sensors. Frames come by one thread, calibration is done by another.

    Args:
        hello: of the bench; its sensors sit on the links 1 to n, each on one.
        steps: what is known of the sensors.

    Attributes:
        steps: what is known of the sensors now.
        samples: how many there were.
        missing, clipped: samples in which each sensor was, (n,).
        heard: sensors that were in the latest sample, (n,).
        estimate: the latest; None before the first, and while the calibration is not complete.

    Raises:
        InvalidValueError: the steps do not fit each other.
    """

    def __init__(self, hello: Hello, steps: CalibrationSteps) -> None:
        self._order = np.argsort([sensor.link for sensor in hello.sensors])
        self._settings = EstimatorSettings(period=1.0 / hello.sample_rate)
        self._kept: deque[ImuSample] = deque(maxlen=round(KEPT * hello.sample_rate))
        self._mutex = threading.Lock()
        self._estimator: AngleEstimator | None = None
        self.samples = 0
        self.missing, self.clipped = (np.zeros(len(hello.sensors), dtype=int) for _ in range(2))
        self.received = np.zeros(len(hello.sensors), dtype=bool)
        self.estimate: AngleEstimate | None = None
        self.steps = steps
        self._zeroed: float | None = None  # the arm was straight and at rest then, by the samples' times [s]
        self._use(steps)

    def take(self, received: Received, frame: ImuFrame) -> ImuSample:
        """A frame came, later than the one before; its sample, sensors from base to tip.

        Samples have the device's own time, which has no jitter [s].
        """
        sample = ImuSample(
            received.device_time / MICROSECONDS,
            frame.angular_rates[self._order],
            frame.specific_forces[self._order],
            frame.clipped[self._order],
            frame.present[self._order],
        )
        with self._mutex:
            self._kept.append(sample)
            self.samples += 1
            self.received = sample.valid
            self.missing += ~sample.valid
            self.clipped += sample.clipped & sample.valid
            self.estimate = None if self._estimator is None else self._estimator.update(sample)
        return sample

    def find_bias(self, rest_time: float) -> None:
        """From the latest samples, over ``rest_time`` [s].

        Raises:
            MeasurementError: the arm moved, or there are too few samples.
        """
        self._step(CalibrationSteps.with_bias, self._latest(rest_time))

    def find_zero(self, rest_time: float) -> None:
        """As `find_bias`."""
        rest = self._latest(rest_time)
        self._step(CalibrationSteps.with_zero, rest)
        self._zeroed = float(rest.times[-1])

    def find_axes(self) -> None:
        """From all samples since the zero was found.

        To which side the arm turns first can only be told of a motion that is known from its beginning on: one that
        was cut anywhere else may begin with the way back, and would turn the sign of all angles.

        Raises:
            MeasurementError: the axes cannot be found from them, or it is too long since the zero was found.
        """
        kept = self._latest(KEPT)
        begin = self._zeroed
        if self.steps.bias is not None and (begin is None or begin < kept.times[0]):
            raise MeasurementError(
                f"the axes are found from the bend after ~/zero, which has to be less than {KEPT:g} s ago; "
                "call it once more while the arm is straight, and then bend the arm"
            )
        self._step(CalibrationSteps.with_axis, kept if begin is None else kept.part(begin, kept.times[-1]))

    def _step(self, step: Callable[[CalibrationSteps, ImuRecording], CalibrationSteps], seen: ImuRecording) -> None:
        steps = step(self.steps, seen)
        self._use(steps)
        self.steps = steps

    def _use(self, steps: CalibrationSteps) -> None:
        calibration = steps.complete()
        estimator = None if calibration is None else AngleEstimator(calibration, self._settings)
        with self._mutex:
            self._estimator, self.estimate = estimator, None

    def _latest(self, duration: float) -> ImuRecording:
        with self._mutex:
            kept = list(self._kept)
        if not kept:
            raise MeasurementError("no samples of the sensors came")
        recording = ImuRecording.of(kept)
        return recording.part(recording.times[-1] - duration, recording.times[-1])

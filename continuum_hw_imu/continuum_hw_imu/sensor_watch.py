"""Estimate joint angles from frames of the sensors, and keep the latest samples for the calibration."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.errors import MeasurementError
from continuum.inertial.angle_estimator import AngleEstimate, AngleEstimator
from continuum.inertial.calibration import CalibrationSteps
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.imu_sample import ImuSample
from continuum_hw_imu.link.received import Received
from continuum_hw_imu.protocol.device_time import MICROSECONDS
from continuum_hw_imu.protocol.messages import Hello, ImuFrame

_MOST_NEWS = 100
"""Most news that wait for a reader."""

KEPT = 60.0
"""Time for which samples are kept [s]."""

LOST = EstimatorSettings().longest_gap
"""Time without data after which a sensor counts as lost [s]: that after which its angle is lost."""


@dataclass(frozen=True)
class SensorNews:
    """A sensor was lost or is back.

    Attributes:
        link: number of its link, from 1.
        name: its name.
        lost: whether it was lost.
        gap: time since its last data before this, by the device's clock [s].
    """

    link: int
    name: str
    lost: bool
    gap: float


class SensorWatch:
    """Watch over one arm's sensors. One thread supplies frames, another one calibrates.

    Args:
        hello: identification of the bench; each of its sensors is on one of the links 1 to n.
        steps: calibration of the sensors.

    Attributes:
        steps: present calibration of the sensors.
        samples: number of samples so far.
        missing, clipped: number of samples in which each sensor was missing or clipped, (n,).
        received: whether each sensor was in the latest sample, (n,).
        estimate: latest estimate; None before the first, and while the calibration is incomplete.
        news: sensors that were lost or are back, oldest first; the reader removes them.

    Raises:
        InvalidValueError: the calibration steps are inconsistent.
    """

    def __init__(self, hello: Hello, steps: CalibrationSteps) -> None:
        self._order = np.argsort([sensor.link for sensor in hello.sensors])
        self._names = [hello.sensors[k].name for k in self._order]
        self._settings = EstimatorSettings(period=1.0 / hello.sample_rate)
        self._kept: deque[ImuSample] = deque(maxlen=round(KEPT * hello.sample_rate))
        self._mutex = threading.Lock()
        self._estimator: AngleEstimator | None = None
        self.samples = 0
        self.missing, self.clipped = (np.zeros(len(hello.sensors), dtype=int) for _ in range(2))
        self.received = np.zeros(len(hello.sensors), dtype=bool)
        self.estimate: AngleEstimate | None = None
        self.news: deque[SensorNews] = deque(maxlen=_MOST_NEWS)
        self._seen: Array | None = None  # time of the latest data of each sensor [s]
        self._lost = np.zeros(len(hello.sensors), dtype=bool)
        self.steps = steps
        self._zeroed: float | None = None  # time of the samples [s] at which the arm was straight and at rest
        self._use(steps)

    def take(self, received: Received, frame: ImuFrame) -> ImuSample:
        """Process a frame, newer than the previous one, and return its sample, with sensors from base to tip.

        The time of a sample is that of the device, which has no jitter [s].
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
        self._note_lost(sample)
        return sample

    def _note_lost(self, sample: ImuSample) -> None:
        seen = np.full(sample.n_sensors, sample.time) if self._seen is None else self._seen
        gap, valid = sample.time - seen, sample.valid
        now_lost = ~valid & (gap > LOST)
        for lost, changed in ((True, now_lost & ~self._lost), (False, valid & self._lost)):
            for k in np.flatnonzero(changed).tolist():
                self.news.append(SensorNews(k + 1, self._names[k], lost, float(gap[k])))
        self._lost = (self._lost | now_lost) & ~valid
        self._seen = np.where(valid, sample.time, seen)

    def find_bias(self, rest_time: float) -> None:
        """Estimate the bias from the latest ``rest_time`` [s] of samples.

        Raises:
            MeasurementError: the arm moved, or there are too few samples.
        """
        self._step(CalibrationSteps.with_bias, self._latest(rest_time))

    def find_zero(self, rest_time: float) -> None:
        """Estimate the zero, as in `find_bias`."""
        rest = self._latest(rest_time)
        self._step(CalibrationSteps.with_zero, rest)
        self._zeroed = float(rest.times[-1])

    def find_axes(self) -> None:
        """Estimate the axes from all samples since the zero was found.

        The side to which the arm turns first is only known for a complete motion: an incomplete one may start with the
        return, which would invert the sign of all angles.

        Raises:
            MeasurementError: the samples do not determine the axes, or the zero was found too long ago.
        """
        kept = self._latest(KEPT)
        begin = self._zeroed
        if self.steps.bias is not None and (begin is None or begin < kept.times[0]):
            raise MeasurementError(
                f"the axes are found from the bend after ~/zero, which must be less than {KEPT:g} s ago; "
                "call it again while the arm is straight, and then bend the arm"
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
            raise MeasurementError("no samples of the sensors have arrived")
        recording = ImuRecording.of(kept)
        return recording.part(recording.times[-1] - duration, recording.times[-1])

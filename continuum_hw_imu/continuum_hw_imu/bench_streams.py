"""Take the data of a bench as they arrive, and publish them while the node is active.

All of it happens in the thread that reads the port, so that nothing delays it.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence

import numpy as np
from builtin_interfaces.msg import Time as TimeMessage
from rclpy.clock import Clock
from rclpy.time import Time

from continuum.inertial.angle_estimator import AngleEstimate
from continuum.inertial.calibration import CalibrationSteps
from continuum.inertial.imu_sample import ImuSample
from continuum_hw_imu.bench_fit import mismatch
from continuum_hw_imu.imu_messages import ImuMessages
from continuum_hw_imu.latency_meter import LatencyMeter
from continuum_hw_imu.link.received import Received
from continuum_hw_imu.protocol.device_time import MICROSECONDS
from continuum_hw_imu.protocol.messages import Hello, ImuFrame, TensionFrame
from continuum_hw_imu.sensor_watch import LOST, SensorWatch
from continuum_manipulator.nodekit.planar_arm import PlanarArm
from continuum_manipulator.nodekit.stamps import NANOSECONDS
from continuum_manipulator.nodekit.two_clocks import read_together

Publish = Callable[[object], None]

SAME = 1e-5
"""Times that differ by less [s] are equal; an estimator that skips a sample keeps the previous estimate."""

FRESH = 0.1
"""Largest age of joint angles that are combined with a measured tension [s]."""

SILENT = 0.5
"""Time without frames of the sensors after which all of them count as lost [s]."""

RIGHT = np.radians(1.5)
"""Error beyond which an angle is wrong [rad]."""

MOST_ACCELERATION = np.radians(13_000.0)
"""Largest angular acceleration of a joint of the prototype, pulled suddenly or let go [rad/s^2]."""

LONGEST_ERROR = np.sqrt(2.0 * RIGHT / MOST_ACCELERATION)
"""Error of a stamp beyond which nothing is published [s]: in it, an arm at rest reaches a wrong angle."""


class BenchStreams:
    """Publishes joint and cable states and the sensors' raw data.

    Joint states are published only if the angles of all joints are right at their stamp, by the errors of estimate and
    stamp, and nothing is while the error of the stamps is not known or large. Stamps are ROS times, without the jitter
    of the transmission.

    Args:
        planar: the arm's names and messages.
        sensors: message factories of the sensors, from base to tip.
        clock: clock of the node.
        steps: calibration of the sensors.
        joints, cables: functions that publish joint and cable states.
        imus: functions that publish the sensors' data, from base to tip.

    Attributes:
        publishing: whether anything is published.
        steps: calibration of the sensors, used when the next bench identifies itself.
        watch: watch of the connected bench's sensors; None before it identifies itself, and if it does not match.
        problem: description of why the bench does not match.
        latency: latency from the last byte of a frame to its published joint states.
        doubt: why the angles of the latest sample are not known; empty if they are.
        frame_read: time at which the latest frame was read from the port, by `time.monotonic` [s].
        lost_for: time from the latest sample with known angles to the latest frame of any kind, by the device's clock
            [s]; infinite before the first such sample of a bench.
        silent: whether no frames of the sensors come for `SILENT` while others do.
        withheld: number of samples whose joint states were not published for that reason.
        age: age of the newest sample when its bytes arrived [s].
        oldest: largest such age since the last diagnostics [s].
        tension: the latest tension frame.
        unfit: number of frames with numbers of sensors or cables that differ from the bench's announcement.
    """

    def __init__(
        self,
        planar: PlanarArm,
        sensors: Sequence[ImuMessages],
        clock: Clock,
        steps: CalibrationSteps,
        joints: Publish,
        cables: Publish,
        imus: Sequence[Publish],
    ) -> None:
        self._planar, self._sensors, self._clock = planar, sensors, clock
        self._joints, self._cables, self._imus = joints, cables, imus
        self._conversation = 0
        self._known_at: float | None = None  # device time of the latest sample with known angles [s]
        self._sampled_at: float | None = None  # device time of the latest sample [s]
        self._latest_at: float | None = None  # device time of the latest frame of any kind [s]
        self.publishing = False
        self.steps = steps
        self.watch: SensorWatch | None = None
        self.problem = ""
        self.latency = LatencyMeter()
        self.doubt = ""
        self.frame_read = math.inf
        self.lost_for = math.inf
        self.silent = False
        self.withheld = 0
        self.unfit = 0
        self.age = self.oldest = 0.0
        self.tension: TensionFrame | None = None

    def take(self, received: Received) -> None:
        """Process a message."""
        if isinstance(received.message, Hello) and received.conversation != self._conversation:
            self._greet(received.message)
            self._conversation = received.conversation
        watch, publishing = self.watch, self.publishing
        if watch is None or received.conversation != self._conversation:
            return
        match received.message:
            case ImuFrame() as frame if len(frame.readings) == len(self._sensors):
                sample = watch.take(received, frame)
                self.age = received.read - received.time
                self.oldest = max(self.oldest, self.age)
                self._judge(watch, received, publishing)
                self._note_lost(received)
                if publishing:
                    stamp = self._stamp(received)
                    self._publish_joints(watch, received, stamp)
                    if received.error <= LONGEST_ERROR:
                        self._publish_imus(sample, stamp)
            case TensionFrame() as frame if len(frame.set_points) == len(self._planar.cables):
                self._note_lost(received)
                self.tension = frame
                if publishing and received.error <= LONGEST_ERROR:
                    self._publish_cables(watch, received, frame)
            case message:
                self._note_lost(received)
                self.unfit += isinstance(message, ImuFrame | TensionFrame)

    def forget(self) -> None:
        """Forget the bench after the line was closed."""
        self._conversation, self.watch, self.problem, self.tension = 0, None, "", None
        self.publishing = False

    def calibrated(self, steps: CalibrationSteps) -> None:
        """Use other steps from now on; the angles have to be found again, and count as known until now."""
        self.steps, self._known_at = steps, self._latest_at

    def _greet(self, hello: Hello) -> None:
        """Start over with another bench, or with the same one after its restart."""
        self.problem = mismatch(hello, len(self._sensors), len(self._planar.cables))
        self.watch = None if self.problem else SensorWatch(hello, self.steps)
        self.tension, self._known_at, self._sampled_at, self._latest_at = None, None, None, None
        self.lost_for = math.inf

    def _judge(self, watch: SensorWatch, received: Received, publishing: bool) -> None:
        """Note whether the angles of a sample are known."""
        self._sampled_at = received.device_time / MICROSECONDS
        self.doubt = _doubt(watch.estimate, self._sampled_at, received.error if publishing else 0.0)
        if not self.doubt:
            self._known_at = self._sampled_at

    def _note_lost(self, received: Received) -> None:
        """Note for how long no angles are known at a frame of any kind: frames of the sensors may fail to come."""
        self._latest_at = now = received.device_time / MICROSECONDS
        known_at = self._known_at  # another thread may move it
        self.frame_read = received.read
        self.lost_for = math.inf if known_at is None else max(0.0, now - known_at)
        self._sampled_at = now if self._sampled_at is None else self._sampled_at
        self.silent = now - self._sampled_at > SILENT
        if now - self._sampled_at > LOST:
            self.doubt = "no frames of the sensors"

    def _stamp(self, received: Received) -> TimeMessage:
        """Return the ROS time of a received message."""
        instant, now = read_together(time.monotonic, lambda: self._clock.now().nanoseconds)
        return Time(nanoseconds=max(0, now - round((instant - received.time) * NANOSECONDS))).to_msg()

    def _publish_joints(self, watch: SensorWatch, received: Received, stamp: TimeMessage) -> None:
        estimate = watch.estimate
        if self.doubt or estimate is None:
            self.withheld += 1
            return
        self._joints(self._planar.joint_state(stamp, estimate.angles, estimate.rates))
        self.latency.note(time.monotonic() - received.read)

    def _publish_imus(self, sample: ImuSample, stamp: TimeMessage) -> None:
        for k, publish in enumerate(self._imus):
            if sample.valid[k]:
                rate, force = sample.rates[k], sample.forces[k]
                publish(self._sensors[k].message(stamp, rate, force, bool(sample.clipped[k])))

    def _publish_cables(self, watch: SensorWatch, received: Received, frame: TensionFrame) -> None:
        """Publish cable states with the lengths of the latest joint states; negative measured tensions become zero."""
        if any(tension is None for tension in frame.measured):
            tensions = np.array([])  # unknown
        else:
            tensions = np.maximum(np.array(frame.measured, dtype=float), 0.0)
        estimate = watch.estimate
        if self.doubt or estimate is None or abs(received.device_time / MICROSECONDS - estimate.time) > FRESH:
            angles, rates = None, None
        else:
            angles, rates = estimate.angles, estimate.rates
        self._cables(self._planar.cable_states(self._stamp(received), angles, rates, tensions))


def _doubt(estimate: AngleEstimate | None, now: float, error: float) -> str:
    """Describe why angles are not known at a device time, whose stamp may err by ``error`` [s]; empty if they are."""
    if estimate is None:
        return "no estimate"
    if not estimate.good.all():
        return "; ".join(dict.fromkeys(filter(None, estimate.why_not)))
    if abs(now - estimate.time) > SAME:
        return "the sample was skipped"
    if np.isinf(error):
        return "the time of the sample is not known"
    missed = np.abs(estimate.rates) * error + 0.5 * MOST_ACCELERATION * error**2  # by the stamp alone
    if np.any(estimate.errors + missed > RIGHT):
        return f"the time of the sample is known to {1e3 * error:.0f} ms only"
    return ""

"""Node that publishes a trajectory as poses and twists of the arm's tip, each at its instant."""

from __future__ import annotations

import time
from collections.abc import Mapping

from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.time import Time

from continuum.parameter_spec import ParameterSpec
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.stamps import NANOSECONDS
from trajectory_generator.from_parameters import trajectory_from_mapping
from trajectory_generator.graph_watch import GraphWatch
from trajectory_generator.parameters import PATH, PATH_PARAMETERS, parameters_of
from trajectory_generator.trajectory_messages import TrajectoryMessages

START_PERIOD = 0.05
"""Time between two checks for the subscribers [s]."""

START_UP = NANOSECONDS
"""First part of the schedule [ns] without warnings of delays: the first messages take longer than the rest."""

PROGRESS_PERIOD = 5.0
"""Time between two log lines about the progress [s]."""

ACKNOWLEDGED_WITHIN = 5.0
"""Time for the subscribers to receive the last messages before the node ends [s]."""


class TrajectoryPublisherNode(CheckedNode):
    """Publishes ``traj_pose`` and ``traj_twist`` with one stamp, ``rate`` times a second, on a schedule without drift.

    The schedule starts with the first messages, when the subscribers are present. Stamps are the instants of the
    schedule, even if the node is late.
    """

    NAME = "trajectory_publisher"
    PARAMETERS = (
        ParameterSpec("subscribers", int, "subscriptions of each topic required before the start", lower=0, default=1),
        ParameterSpec("wait_for_nodes", str, "names of nodes that must run before the start", is_list=True, default=[]),
        ParameterSpec(
            "settle_time", float, "time without a change of nodes or topics before the start", "s", 0.0, 60.0,
            default=0.5,
        ),
        ParameterSpec(
            "wait_timeout", float, "time after which the trajectory starts even if some are missing", "s", 0.0,
            1e6, default=60.0,
        ),
        ParameterSpec("loop", bool, "restart at the end", default=False),
        ParameterSpec("exit_at_end", bool, "end the process at the end", default=False),
    )  # fmt: skip

    def __init__(self) -> None:
        super().__init__()
        own = {spec.name for spec in self.PARAMETERS}
        trajectory = trajectory_from_mapping({name: value for name, value in self.values.items() if name not in own})
        self._rate: float = self.values["rate"]
        self._messages = TrajectoryMessages(trajectory, self._rate)
        self._messages.at(0, Time().to_msg())  # the slow first sampling happens before the schedule starts
        self._next = 0
        self._start: int | None = None
        self.diagnostics.values["progress"] = lambda: f"{self._next} of {len(self._messages)} instants"
        self._publish_pose = self.offer(PoseStamped, "traj_pose")
        self._publish_twist = self.offer(TwistStamped, "traj_twist")
        self._watch = GraphWatch(self, self.values["wait_for_nodes"], self._received, self.values["settle_time"])
        self._wait_until = time.monotonic() + self.values["wait_timeout"]
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._wait_timer = self.create_timer(START_PERIOD, self._wait, clock=steady)
        self._progress_timer = self.create_timer(PROGRESS_PERIOD, self._report_progress, clock=steady)

    @classmethod
    def all_parameter_specs(cls) -> tuple[ParameterSpec, ...]:
        of_paths = {spec.name: spec for kind in PATH_PARAMETERS for spec in parameters_of(kind)}
        return (*cls.PARAMETERS, *of_paths.values())

    @classmethod
    def parameter_specs(cls, given: Mapping[str, object]) -> tuple[ParameterSpec, ...]:
        return (*cls.PARAMETERS, *parameters_of(given.get(PATH.name, PATH.default)))

    def _received(self) -> bool:
        return min(self._publish_pose.subscribers, self._publish_twist.subscribers) >= self.values["subscribers"]

    def _wait(self) -> None:
        if self.get_clock().now().nanoseconds == 0:
            return  # simulated time has not started
        if not self._watch.ready():
            if time.monotonic() < self._wait_until:
                return
            self.diagnostics.warnings.note("started without all listeners", self._who_is_missing())
        self.destroy_timer(self._wait_timer)
        period = 1.0 / self._rate
        self._timer = self.create_timer(period, self._publish_due)
        self.get_logger().info(f"trajectory of {self._messages.duration:.1f} s at {self._rate:g} Hz begins")

    def _who_is_missing(self) -> str:
        wanted = self.values["subscribers"]
        received = {"traj_pose": self._publish_pose.subscribers, "traj_twist": self._publish_twist.subscribers}
        missing = [f"{topic} has {n} of {wanted} subscriptions" for topic, n in received.items() if n < wanted]
        missing += [f"node {name} does not run" for name in self._watch.missing()]
        return ", ".join(missing) or "all are present, but nodes or topics still change"

    def _publish_due(self) -> None:
        """Publish every due instant, up to half a period early."""
        now = self.get_clock().now().nanoseconds
        if self._start is None:
            self._start = now
        half = round(0.5 / self._rate * NANOSECONDS)
        late = now - self._instant(self._next)
        started = now - self._start > START_UP
        if started and late > max(4 * half, NANOSECONDS // 50):
            self.diagnostics.warnings.note("behind the schedule", f"{late / 1e6:.0f} ms late; stamps are kept")
        while self._instant(self._next) <= now + half:
            stamp = Time(nanoseconds=self._instant(self._next)).to_msg()
            pose, twist = self._messages.at(self._next % len(self._messages), stamp)
            self._publish_pose(pose)
            self._publish_twist(twist)
            self._next += 1
            if self._next == len(self._messages) and not self.values["loop"]:
                self._end()
                return

    def _instant(self, i: int) -> int:
        """Return the time of instant ``i`` [ns], counted continuously through all rounds of a loop."""
        return self._start + round(i * NANOSECONDS / self._rate)

    def _report_progress(self) -> None:
        if 0 < self._next < len(self._messages):
            share = self._next / len(self._messages)
            self.get_logger().info(f"{100 * share:.0f} %, {self._next} of {len(self._messages)} poses")
        elif self._start is None:
            self.get_logger().info(f"waiting for listeners: {self._who_is_missing()}")

    def _end(self) -> None:
        self.destroy_timer(self._timer)
        self.get_logger().info(f"trajectory ended, {self._next} poses published")
        self.finished = bool(self.values["exit_at_end"])

    def close(self) -> None:
        if not self.finished:
            return  # stopped from outside: end at once
        self._publish_pose.wait_until_received(ACKNOWLEDGED_WITHIN)
        self._publish_twist.wait_until_received(ACKNOWLEDGED_WITHIN)

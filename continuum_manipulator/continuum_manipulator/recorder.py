"""Node that records topics to rosbag2."""

from __future__ import annotations

import importlib
import time
from contextlib import suppress
from dataclasses import dataclass

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription
from rosbags.interfaces import Connection

from continuum.errors import FileError
from continuum.parameter_spec import ParameterSpec
from continuum.recordings.bag import recovery_command
from continuum_manipulator.bag_qos import offered, received_by_all
from continuum_manipulator.bag_writer import STORAGES, BagWriter
from continuum_manipulator.message_definitions import message_definition
from continuum_manipulator.nodekit.checked_node import CheckedNode

SCAN_PERIOD = 0.1
"""Time between two searches for new topics and publishers [s]."""

DRAIN_LIMIT = 3.0
"""Longest time that a stopped recorder waits for messages in transit [s]."""

QUIET = 0.5
"""Time without a message after which a stopped recorder assumes that none is in transit [s]."""


@dataclass
class _Recorded:
    """One topic: its subscription, and after the first message its handle in the recording."""

    message_type: str
    qos: QoSProfile
    subscription: Subscription
    place: Connection | None = None


class RecorderNode(CheckedNode):
    """Records topics to a rosbag2 folder as soon as they appear, with the quality of service of their publishers.

    It logs ``recording N topics`` whenever it subscribes to further topics, with the requested topics that are still
    missing, and a summary at the end.
    """

    NAME = "recorder"
    PARAMETERS = (
        ParameterSpec("topics", str, "topics to record; empty: all topics, including later ones",
                      is_list=True, default=[]),
        ParameterSpec("output", str, "new folder for the recording; empty: rosbag2_<date>", default=""),
        ParameterSpec("storage", str, "format of the recording", choices=STORAGES, default="mcap"),
        ParameterSpec(
            "flush_period", float, "longest time until a message is safe even if the recorder is killed", "s", 0.01,
            3600.0, default=1.0,
        ),
    )  # fmt: skip

    def __init__(self) -> None:
        super().__init__()
        self._wanted = {self.resolve_topic_name(topic) for topic in self.values["topics"]}
        self._recorded: dict[str, _Recorded] = {}
        self._refused: set[str] = set()
        self._drain_until: float | None = None
        self._count_before = -1
        self._quiet_since = 0.0
        self._bag = BagWriter(
            self.values["output"] or time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S"), self.values["storage"]
        )
        self.diagnostics.values["recording"] = lambda: self._bag.path
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._scan_timer = self.create_timer(SCAN_PERIOD, self._scan, clock=steady)
        self._flush_timer = self.create_timer(self.values["flush_period"], self._bag.flush, clock=steady)
        self._scan()
        if waiting := self._waiting():
            self.get_logger().info(f"waiting for {waiting}")

    def _waiting(self) -> str:
        """List the requested topics that do not exist yet."""
        return ", ".join(sorted(self._wanted - self._recorded.keys() - self._refused))

    def _scan(self) -> None:
        """Subscribe to new topics, and again to topics with a publisher that offers less than the present request."""
        before = len(self._recorded)
        for topic, types in self.get_topic_names_and_types():
            if topic in self._refused or (self._wanted and topic not in self._wanted):
                continue
            profiles = self._profiles(topic)
            qos = received_by_all(profiles)
            recorded = self._recorded.get(topic)
            if recorded is None:
                self._record(topic, types[0], qos)
            elif profiles and qos != recorded.qos:
                self.destroy_subscription(recorded.subscription)
                recorded.qos = qos
                recorded.subscription = self._subscribe(topic, recorded.message_type, qos)
        if len(self._recorded) > before:
            waiting = self._waiting()
            more = f"; waiting for {waiting}" if waiting else ""
            self.get_logger().info(f"recording {len(self._recorded)} topics to {self._bag.path}{more}")

    def _profiles(self, topic: str) -> list[QoSProfile]:
        return [info.qos_profile for info in self.get_publishers_info_by_topic(topic)]

    def _record(self, topic: str, message_type: str, qos: QoSProfile) -> None:
        try:
            message_definition(message_type)
            self._recorded[topic] = _Recorded(message_type, qos, self._subscribe(topic, message_type, qos))
        except FileError as error:
            self._refused.add(topic)
            self.diagnostics.warnings.note("topics that cannot be recorded", f"{topic}: {error}")

    def _subscribe(self, topic: str, message_type: str, qos: QoSProfile) -> Subscription:
        received, clock = self.diagnostics.received, self.get_clock()

        def write(raw: bytes) -> None:
            self._bag.write(self._place(topic), raw, clock.now().nanoseconds)
            received[topic] += 1

        return self.create_subscription(_message_class(message_type), topic, write, qos, raw=True)

    def _place(self, topic: str) -> Connection:
        """Return the topic's handle; it is added with the first message, when its publishers' offers are known."""
        recorded = self._recorded[topic]
        if recorded.place is None:
            offers = [offered(profile) for profile in self._profiles(topic)]
            recorded.place = self._bag.add_topic(topic, recorded.message_type, offers)
        return recorded.place

    def draining(self) -> bool:
        """Continue until messages stop, so that publishers that are stopped at the same time finish first."""
        now, count = time.monotonic(), self.diagnostics.received.total()
        if self._drain_until is None:
            self._drain_until = now + DRAIN_LIMIT
        if count > self._count_before:
            self._count_before, self._quiet_since = count, now
        return now < min(self._drain_until, self._quiet_since + QUIET)

    def give_up(self, problem: str) -> str:
        """Finish the recording as far as possible, and name the command that recovers the rest."""
        with suppress(FileError):
            self._bag.close()
        return f"{problem}; recover the data written before with {recovery_command(self._bag.path)}"

    def close(self) -> None:
        super().close()
        for topic in self._recorded:
            self._place(topic)  # topics without a message are listed too
        self._bag.close()
        counts = dict.fromkeys(self._wanted, 0) | self._bag.counts
        lines = [f"{count:>8}  {topic}" for topic, count in sorted(counts.items())]
        self.get_logger().info(
            "\n".join(
                [
                    f"recorded {sum(counts.values())} messages of {len(self._recorded)} topics to {self._bag.path}",
                    *lines,
                ]
            )
        )


def _message_class(message_type: str) -> type:
    """Return the Python class of a message type, e.g. ``sensor_msgs/msg/JointState``.

    Raises:
        FileError: the type is not installed.
    """
    package, folder, name = message_type.split("/")
    try:
        return getattr(importlib.import_module(f"{package}.{folder}"), name)
    except (ImportError, AttributeError) as error:
        raise FileError(message_type, f"cannot be imported ({error})") from error

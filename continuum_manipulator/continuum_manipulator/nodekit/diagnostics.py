"""Counts of a node's received, published and refused messages, on ``/diagnostics`` once a second."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node

from continuum.burst_log import BurstLog
from continuum_manipulator.nodekit.qos import REPORT

PERIOD = 1.0
"""Time between two reports by the machine's clock [s]; reports continue while simulated time stands still."""

RECENT = 5.0
"""Time for which an event keeps the status at WARN [s]."""


class Diagnostics:
    """Counts of one node and their report.

    The status is WARN if a message was refused, or a warning was recorded, within the last seconds.

    Attributes:
        received, published: number of messages by topic.
        ignored: number of messages for other nodes.
        faults: refused messages by cause.
        warnings: other warnings by cause.
        values: functions of further entries, called for each report.
        subjects: functions that return further statuses, called for each report.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self.received: Counter[str] = Counter()
        self.published: Counter[str] = Counter()
        self.ignored: Counter[str] = Counter()
        self.faults = BurstLog(lambda line: node.get_logger().warning(line), time.monotonic, "dropped, ")
        self.warnings = BurstLog(lambda line: node.get_logger().warning(line), time.monotonic)
        self.values: dict[str, Callable[[], object]] = {}
        self.subjects: list[Callable[[], DiagnosticStatus]] = []
        self._seen = 0
        self._warn_until = -float("inf")
        self._publisher = node.create_publisher(DiagnosticArray, "/diagnostics", REPORT)
        self._timer = node.create_timer(PERIOD, self.report, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def report(self) -> None:
        """Publish the counts, and write pending summaries to the logs."""
        self.faults.tick()
        self.warnings.tick()
        message = DiagnosticArray(status=[self._status(), *(subject() for subject in self.subjects)])
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(message)

    def _status(self) -> DiagnosticStatus:
        events, now = self.faults.total + self.warnings.total, time.monotonic()
        if events > self._seen:
            self._seen, self._warn_until = events, now + RECENT
        warn = now < self._warn_until
        causes = [f"{count} {cause}" for cause, count in (self.faults.counts + self.warnings.counts).items()]
        return DiagnosticStatus(
            level=DiagnosticStatus.WARN if warn else DiagnosticStatus.OK,
            name=f"{self._node.get_fully_qualified_name().lstrip('/')}: messages",
            message=", ".join(causes) if warn else "running",
            values=[KeyValue(key=key, value=str(value)) for key, value in self._entries()],
        )

    def _entries(self) -> list[tuple[str, object]]:
        entries: list[tuple[str, object]] = []
        for word, counts in (("received", self.received), ("published", self.published), ("ignored", self.ignored)):
            entries += [(f"{word} {topic}", count) for topic, count in counts.items()]
        entries.append(("dropped", self.faults.total))
        entries += [(f"dropped: {cause}", count) for cause, count in self.faults.counts.items()]
        entries += list(self.warnings.counts.items())
        return entries + [(key, value()) for key, value in self.values.items()]

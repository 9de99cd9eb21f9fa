"""A node within the test that listens and speaks to the nodes under test."""

from __future__ import annotations

import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, ClassVar

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rcl_interfaces.srv import GetParameters
from rclpy.client import Client
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile

from continuum_manipulator.nodekit.qos import REPORT, STREAM
from harness.waiting import LONG

LEVELS = {getattr(DiagnosticStatus, name): name for name in ("OK", "WARN", "ERROR", "STALE")}


class Probe:
    """Speaks on topics and keeps all that it hears. Use as a context.

    Args:
        domain: ROS domain.
        name: of its node.
    """

    _silent: ClassVar[set[str]] = set()  # names of probes: they answer no requests while they do not listen

    def __init__(self, domain: int, name: str = "probe") -> None:
        self._context = Context()
        rclpy.init(context=self._context, domain_id=domain)
        self.node = rclpy.create_node(name, context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._silent.add(name)
        self._received: list[list[Any]] = []
        self._reports: dict[str, dict[str, str]] = {}
        self._clients: dict[str, Client] = {}
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self._on_diagnostics, REPORT)

    def __enter__(self) -> Probe:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None):
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.try_shutdown(context=self._context)

    def hear(self, message_type: type, topic: str, qos: QoSProfile = STREAM) -> list[Any]:
        """Subscribe; the returned list grows with every message."""
        received: list[Any] = []
        self.node.create_subscription(message_type, topic, received.append, qos)
        self._received.append(received)
        return received

    def speaker(self, message_type: type, topic: str, listeners: int = 1, qos: QoSProfile = STREAM) -> Publisher:
        """Advertise, and wait until so many subscriptions are there."""
        publisher = self.node.create_publisher(message_type, topic, qos)
        self.wait_until(lambda: publisher.get_subscription_count() >= listeners, f"{listeners} listeners on {topic}")
        return publisher

    def wait_until(self, condition: Callable[[], object], what: object, timeout: float = LONG) -> None:
        """Listen until ``condition`` holds; fail with ``what`` after ``timeout`` [s]."""
        deadline = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > deadline:
                raise AssertionError(f"not within {timeout} s: {what() if callable(what) else what}")
            self._executor.spin_once(timeout_sec=0.05)

    def spin(self, longest: float) -> None:
        """Listen to what comes next, for so long at the most [s]."""
        self._executor.spin_once(timeout_sec=longest)

    def wait_for_nodes(self, *names: str) -> None:
        """Listen until nodes of these names run."""
        self.wait_until(lambda: set(names) <= set(self.node.get_node_names()), f"nodes {', '.join(names)}")

    def warm_up(self, send: Callable[[], None], *received: list[Any]) -> None:
        """Send until every list has something, then until all answers have come, and empty the lists.

        That both ends know of each other here does not say that the nodes under test know it too.
        """
        deadline = time.monotonic() + LONG
        while not all(received):
            assert time.monotonic() < deadline, "no answer"
            send()
            again = time.monotonic() + 0.5
            while not all(received) and time.monotonic() < again:
                self._executor.spin_once(timeout_sec=0.05)
        self.settle()
        for messages in received:
            messages.clear()

    def settle(self) -> None:
        """Listen until all that was said is answered, however busy the machine is.

        A node takes messages and requests in the order of their arrival: once it has answered a request, it has
        answered the messages that arrived before. Where nodes hear each other, this is repeated until nothing comes.
        """
        for publisher in self.node.publishers:
            assert publisher.wait_for_all_acked(Duration(seconds=LONG))
        before = -1
        while before != (before := sum(map(len, self._received))):
            for name, namespace in self.node.get_node_names_and_namespaces():
                if name not in self._silent:
                    self._ask(f"{namespace.rstrip('/')}/{name}/get_parameters")
            for _ in range(20 + sum(map(len, self._received)) - before):  # what has come but is not taken yet
                self._executor.spin_once(timeout_sec=0.0)

    def _ask(self, service: str) -> None:
        """Ask a node for the values of no parameters; one that has ended does not answer."""
        if service not in self._clients:
            self._clients[service] = self.node.create_client(GetParameters, service)
        client = self._clients[service]
        self.wait_until(lambda: client.service_is_ready() or not self._runs(service), service)
        if client.service_is_ready():
            answer = client.call_async(GetParameters.Request())
            self.wait_until(lambda: answer.done() or not client.service_is_ready(), f"an answer of {service}")

    def _runs(self, service: str) -> bool:
        names = self.node.get_node_names_and_namespaces()
        return any(f"{namespace.rstrip('/')}/{name}/get_parameters" == service for name, namespace in names)

    def listen_until_quiet(self, quiet: float = 0.3) -> None:
        """Listen until the topics have been silent for ``quiet`` [s]."""
        last, before = time.monotonic(), sum(map(len, self._received))
        while time.monotonic() - last < quiet:
            self._executor.spin_once(timeout_sec=0.05)
            if sum(map(len, self._received)) != before:
                last, before = time.monotonic(), sum(map(len, self._received))

    def report(self, node: str) -> dict[str, str]:
        """The latest diagnostics of a node: its values by key, and ``level`` as OK, WARN, ERROR or STALE; empty before.

        A further status of the node is asked for by its whole name, ``node: subject``; its words are in ``message``.
        """
        return self._reports.get(node, {})

    def count(self, node: str, key: str) -> int:
        """A number of the node's latest diagnostics, 0 where it has no such entry."""
        return int(self.report(node).get(key, 0))

    def forget(self, node: str) -> None:
        """Drop the latest diagnostics of a node: the next that are seen are new."""
        self._reports.pop(node, None)

    def wait_for_report(self, node: str) -> None:
        """Listen until diagnostics of the node come that are made from now on."""
        self.forget(node)
        self.wait_until(lambda: self.report(node), f"diagnostics of {node}")

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            values = {entry.key: entry.value for entry in status.values}
            values |= {"level": LEVELS[status.level], "message": status.message}
            self._reports[status.name.removesuffix(": messages")] = values

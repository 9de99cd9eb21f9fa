"""Base class of all nodes of the workspace: checked parameters, checked messages, diagnostics."""

from __future__ import annotations

import inspect
import json
import shlex
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from copy import copy
from typing import Any, ClassVar

import numpy as np
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.subscription import Subscription

from continuum.arm import Arm
from continuum.errors import ContinuumError
from continuum.parameter_spec import ParameterSpec, Value
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.diagnostics import Diagnostics
from continuum_manipulator.nodekit.faults import MessageFault
from continuum_manipulator.nodekit.occasional_publisher import OccasionalPublisher
from continuum_manipulator.nodekit.parameters import (
    declare_arm,
    declare_parameters,
    given_parameters,
    refuse_unknown,
)
from continuum_manipulator.nodekit.qos import STREAM
from continuum_manipulator.nodekit.qos_overrides import check_overrides, refuse_unknown_overrides

_WITH_INFO = inspect.signature(lambda _message, _info: None)
"""What tells rclpy that a callback takes the stamps of a message too. The EventsExecutor of rclpy 7.1 then hands both
over as one tuple, every other executor as two arguments."""

FAREWELL = 1.0
"""Longest time that an ending node waits for its messages to be received [s]."""


class CountedPublisher:
    """Callable that publishes and counts messages.

    Attributes:
        publisher: the underlying publisher.
    """

    def __init__(self, publisher: Publisher, topic: str, counts: Counter[str]) -> None:
        self.publisher = publisher
        self._topic = topic
        self._counts = counts
        counts[topic] += 0

    def __call__(self, message: object) -> None:
        self.publisher.publish(message)
        self._counts[self._topic] += 1

    @property
    def subscribers(self) -> int:
        """Number of matched subscriptions."""
        return self.publisher.get_subscription_count()

    def wait_until_received(self, timeout: float) -> None:
        """Wait at most ``timeout`` [s] until every subscription has confirmed all messages."""
        self.publisher.wait_for_all_acked(Duration(seconds=timeout))


class CheckedNode(Node):
    """A node with specified parameters, which reports a message that a handler refuses in one line.

    Attributes:
        NAME: name of the node unless it is remapped.
        PARAMETERS: specifications of the node's parameters.
        HAS_ARM: whether it also accepts the block ``arm.*``, available as ``self.arm``.
        values: values of the parameters.
        finished: set by the node to end the process.

    Raises:
        ContinuumError: a parameter is wrong, missing or unknown.
    """

    NAME: ClassVar[str]
    PARAMETERS: ClassVar[tuple[ParameterSpec, ...]] = ()
    HAS_ARM: ClassVar[bool] = False

    arm: Arm

    def __init__(self) -> None:
        super().__init__(self.NAME, automatically_declare_parameters_from_overrides=True)
        self._qos_parameters: set[str] = set()
        given = given_parameters(self)
        specs = self.parameter_specs(given)
        refuse_unknown(given, specs, self.HAS_ARM)
        if self.HAS_ARM:
            self.arm = declare_arm(self, given, self.default_arm())
        self.values: dict[str, Value] = declare_parameters(self, specs, self.completed(given))
        self.finished = False
        self._received_at = 0
        self.diagnostics = Diagnostics(self)

    def declare_parameters(
        self, namespace: str, parameters: Sequence[tuple[str, Any, ParameterDescriptor]], ignore_override: bool = False
    ) -> list[Parameter]:
        """As rclpy's method, which receives all overrides, but ignore empty lists, which have no type in ROS."""
        typed = [entry for entry in parameters if entry[1] is not None]
        return super().declare_parameters(namespace, typed, ignore_override)

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """As rclpy's method, but the refusal of a read-only parameter says how to restart the node with the value.

        A value of the arm is changed in its file, which may give it by another name or in another unit.
        """
        result = super().set_parameters_atomically(parameter_list)
        for parameter in [] if result.successful else parameter_list:
            descriptor = self.describe_parameter(parameter.name)
            if not descriptor.read_only or descriptor.type != parameter.type_.value:
                continue
            if parameter.name.startswith("arm."):
                how = "Change the arm file, and restart the node."
            else:
                how = f"Restart the node with: --ros-args -p {shlex.quote(f'{parameter.name}:={_yaml(parameter)}')}"
            result.reason = f"{result.reason.rstrip('.')}. {how}"
        return result

    @classmethod
    def parameter_specs(cls, given: Mapping[str, object]) -> tuple[ParameterSpec, ...]:  # noqa: ARG003
        """Return the node's parameters; override this if some depend on the given values."""
        return cls.PARAMETERS

    def completed(self, given: Mapping[str, object]) -> Mapping[str, object]:
        """Return the given parameters; override this to add values that depend on the arm."""
        return given

    @classmethod
    def default_arm(cls) -> Arm | None:
        """Return the arm if no parameter defines one; override this in nodes that do not require an arm."""
        return None

    @classmethod
    def all_parameter_specs(cls) -> tuple[ParameterSpec, ...]:
        """Return all parameters that the node may have, independent of the given values."""
        return cls.parameter_specs({})

    def listen(
        self,
        message_type: type,
        topic: str,
        handle: Callable[[Any], None],
        qos: QoSProfile = STREAM,
        timed: bool = False,
    ) -> Subscription:
        """Subscribe to a topic; message faults that ``handle`` raises are counted and logged without stopping.

        With ``timed``, ``handle`` may ask for the `arrival` of its message, which costs time for every message.
        """
        received = self.diagnostics.received
        received[topic] = 0
        checked = self.checked(topic, handle)

        def on_message(message: object) -> None:
            received[topic] += 1
            checked(message)

        def on_timed_message(*given: Any) -> None:
            message, info = given if len(given) == 2 else given[0]
            self._received_at = info["received_timestamp"]
            on_message(message)

        on_timed_message.__signature__ = _WITH_INFO  # type: ignore[attr-defined]

        def on_loss(event: Any) -> None:
            cause, now = "messages lost on the way", event.total_count_change
            self.diagnostics.warnings.note(cause, f"{topic}: {now}, in all {event.total_count}", now)

        return self.create_subscription(
            message_type,
            topic,
            on_timed_message if timed else on_message,
            self._overridden(qos, topic, "subscription"),
            event_callbacks=SubscriptionEventCallbacks(message_lost=on_loss),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )

    def arrival(self) -> int:
        """Return the ROS time [ns] at which the timed message under handling arrived, however late the node handles it.

        The middleware notes the arrival by the machine's clock in a thread of its own. A middleware that does not (it
        gives 0) leaves the present. In simulated time, the wait within the node is taken as long as by the machine's
        clock.
        """
        waited = max(0, time.time_ns() - self._received_at) if self._received_at else 0
        return int(self.get_clock().now().nanoseconds) - waited

    def checked(self, topic: str, handle: Callable[[Any], None]) -> Callable[[Any], None]:
        """Wrap ``handle`` so that message faults of ``topic`` are counted and logged."""
        faults = self.diagnostics.faults

        def handle_checked(message: object) -> None:
            try:
                with np.errstate(over="raise"):
                    handle(message)
            except MessageFault as fault:
                faults.note(fault.cause, f"{topic}: {fault.detail}")
            except ContinuumError as error:
                faults.note(messages.REFUSED, f"{topic}: {error}")
            except FloatingPointError:
                faults.note(messages.REFUSED, f"{topic}: numbers too large to compute with")

        return handle_checked

    def offer(self, message_type: type, topic: str, qos: QoSProfile = STREAM) -> CountedPublisher:
        """Advertise a topic."""
        publisher = self.create_publisher(
            message_type,
            topic,
            self._overridden(qos, topic, "publisher"),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )
        return CountedPublisher(publisher, topic, self.diagnostics.published)

    def offer_at_times(self, message_type: type, topic: str, qos: QoSProfile = STREAM) -> OccasionalPublisher:
        """Return a publisher that advertises the topic only while it is in use."""
        self._overridden(qos, topic, "publisher")
        self.diagnostics.published[topic] += 0
        return OccasionalPublisher(
            lambda: self.offer(message_type, topic, qos), lambda counted: self.destroy_publisher(counted.publisher)
        )

    def _overridden(self, qos: QoSProfile, topic: str, end: str) -> QoSProfile:
        """Check the parameters ``qos_overrides`` of a topic, and return a copy of ``qos`` for rclpy to change."""
        self._qos_parameters |= check_overrides(self, self.resolve_topic_name(topic), end)
        return copy(qos)

    def refuse_unknown_overrides(self) -> None:
        """Check that all given ``qos_overrides`` belong to a topic of the node; call this after all topics exist.

        Raises:
            UnknownParameterError: one belongs to another topic.
        """
        refuse_unknown_overrides(self, self._qos_parameters)

    def in_words(self) -> str:
        """Describe the work of the node beyond its topics; empty by default."""
        return ""

    def greet(self) -> None:
        """Log in one line that the node is ready, with its work and its topics."""
        topics = {"takes": self.diagnostics.received, "gives": self.diagnostics.published}
        parts = [self.in_words(), *(f"{word} {', '.join(names)}" for word, names in topics.items() if names)]
        if any(parts):
            self.get_logger().info("; ".join(filter(None, parts)))

    def draining(self) -> bool:
        """Return whether the node must still be served after a request to stop, before it is closed."""
        return False

    def close(self) -> None:
        """Wait for the delivery of messages; called once before the process ends, also after a signal."""
        deadline = time.monotonic() + FAREWELL
        for publisher in self.publishers:
            publisher.wait_for_all_acked(Duration(seconds=max(0.0, deadline - time.monotonic())))

    def give_up(self, problem: str) -> str:
        """Return the final error line; called once instead of :meth:`close` when the node cannot continue."""
        return problem


def _yaml(parameter: Parameter) -> str:
    """Return the parameter's value for `-p name:=VALUE`: JSON, which is YAML in one line."""
    value = parameter.value
    return json.dumps(value.tolist() if hasattr(value, "tolist") else value, ensure_ascii=False, default=str)

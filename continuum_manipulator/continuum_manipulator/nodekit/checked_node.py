"""The base of every node of the workspace: checked parameters, checked messages, diagnostics."""

from __future__ import annotations

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

FAREWELL = 1.0
"""Longest time that a node which ends waits for what it published to be received [s]."""


class CountedPublisher:
    """Publishes by being called with a message, and counts.

    Attributes:
        publisher: the publisher itself.
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
        """Subscriptions that it reaches."""
        return self.publisher.get_subscription_count()

    def wait_until_received(self, timeout: float) -> None:
        """Wait until every subscription has confirmed what was published, ``timeout`` [s] at most."""
        self.publisher.wait_for_all_acked(Duration(seconds=timeout))


class CheckedNode(Node):
    """A node whose parameters are specified, and whose handlers see only messages that they can refuse in one line.

    Attributes:
        NAME: the node's name unless it is remapped.
        PARAMETERS: its own parameters.
        HAS_ARM: it also takes the block ``arm.*``, then in ``self.arm``.
        values: its parameters' values.
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
        self.values: dict[str, Value] = declare_parameters(self, specs, given)
        self.finished = False
        self.diagnostics = Diagnostics(self)

    def declare_parameters(
        self, namespace: str, parameters: Sequence[tuple[str, Any, ParameterDescriptor]], ignore_override: bool = False
    ) -> list[Parameter]:
        """As rclpy's, which calls it with all that is given; an empty list has no type there: it is as if not given."""
        typed = [entry for entry in parameters if entry[1] is not None]
        return super().declare_parameters(namespace, typed, ignore_override)

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """As rclpy's; the refusal of a read-only parameter says how to start the node with the value."""
        result = super().set_parameters_atomically(parameter_list)
        if not result.successful:
            read_only = [p for p in parameter_list if self.describe_parameter(p.name).read_only]
            if read_only:
                options = " ".join(f"-p {shlex.quote(f'{p.name}:={_yaml(p)}')}" for p in read_only)
                result.reason += f" Restart the node with: --ros-args {options}"
        return result

    @classmethod
    def parameter_specs(cls, given: Mapping[str, object]) -> tuple[ParameterSpec, ...]:  # noqa: ARG003
        """The node's own parameters; to be overridden where some depend on what is given."""
        return cls.PARAMETERS

    @classmethod
    def default_arm(cls) -> Arm | None:
        """The arm where no parameter says one; to be overridden by nodes that can do without being told."""
        return None

    @classmethod
    def all_parameter_specs(cls) -> tuple[ParameterSpec, ...]:
        """The node's own parameters, whatever is given."""
        return cls.parameter_specs({})

    def listen(
        self, message_type: type, topic: str, handle: Callable[[Any], None], qos: QoSProfile = STREAM
    ) -> Subscription:
        """Subscribe; what ``handle`` raises as a fault of the message is counted and told, and the node goes on."""
        received = self.diagnostics.received
        received[topic] = 0
        checked = self.checked(topic, handle)

        def on_message(message: object) -> None:
            received[topic] += 1
            checked(message)

        def on_loss(event: Any) -> None:
            cause, now = "messages lost on the way", event.total_count_change
            self.diagnostics.warnings.note(cause, f"{topic}: {now}, in all {event.total_count}", now)

        return self.create_subscription(
            message_type,
            topic,
            on_message,
            self._overridden(qos, topic, "subscription"),
            event_callbacks=SubscriptionEventCallbacks(message_lost=on_loss),
            qos_overriding_options=QoSOverridingOptions.with_default_policies(),
        )

    def checked(self, topic: str, handle: Callable[[Any], None]) -> Callable[[Any], None]:
        """``handle`` that counts and tells what it raises as a fault of a message of ``topic``."""
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
        """A topic that is advertised only while something is to be said."""
        self._overridden(qos, topic, "publisher")
        self.diagnostics.published[topic] += 0
        return OccasionalPublisher(
            lambda: self.offer(message_type, topic, qos), lambda counted: self.destroy_publisher(counted.publisher)
        )

    def _overridden(self, qos: QoSProfile, topic: str, end: str) -> QoSProfile:
        """A copy for rclpy to change, once the node's parameters ``qos_overrides`` for it are checked."""
        self._qos_parameters |= check_overrides(self, self.resolve_topic_name(topic), end)
        return copy(qos)

    def refuse_unknown_overrides(self) -> None:
        """To be called when all topics are there: none of the given ``qos_overrides`` is for another.

        Raises:
            UnknownParameterError: one is.
        """
        refuse_unknown_overrides(self, self._qos_parameters)

    def in_words(self) -> str:
        """What the node is at work on, where there is more to say than its topics."""
        return ""

    def greet(self) -> None:
        """Say in one line that the node works, what on, and by which topics."""
        topics = {"takes": self.diagnostics.received, "gives": self.diagnostics.published}
        parts = [self.in_words(), *(f"{word} {', '.join(names)}" for word, names in topics.items() if names)]
        if any(parts):
            self.get_logger().info("; ".join(filter(None, parts)))

    def draining(self) -> bool:
        """Asked after a request to stop: whether the node still has to be served before it is closed."""
        return False

    def close(self) -> None:
        """Called once before the process ends, also after a signal: what was published gets where it is heard."""
        deadline = time.monotonic() + FAREWELL
        for publisher in self.publishers:
            publisher.wait_for_all_acked(Duration(seconds=max(0.0, deadline - time.monotonic())))

    def give_up(self, problem: str) -> str:
        """Called once in the place of :meth:`close` when the node cannot go on; the line that is told of it."""
        return problem


def _yaml(parameter: Parameter) -> str:
    """The parameter's value as `-p name:=VALUE` takes it: JSON, which is YAML in one line."""
    value = parameter.value
    return json.dumps(value.tolist() if hasattr(value, "tolist") else value, ensure_ascii=False, default=str)

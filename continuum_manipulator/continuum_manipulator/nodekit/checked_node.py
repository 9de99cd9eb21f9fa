"""The base of every node of the workspace: checked parameters, checked messages, diagnostics."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any, ClassVar

import numpy as np
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

from continuum.arm import Arm
from continuum.errors import ContinuumError
from continuum.parameter_spec import ParameterSpec, Value
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.diagnostics import Diagnostics
from continuum_manipulator.nodekit.faults import MessageFault
from continuum_manipulator.nodekit.parameters import (
    declare_arm,
    declare_parameters,
    given_parameters,
    refuse_unknown,
)
from continuum_manipulator.nodekit.qos import STREAM


class CountedPublisher:
    """Publishes by being called with a message, and counts."""

    def __init__(self, publisher: Publisher, topic: str, counts: Counter[str]) -> None:
        self._publisher = publisher
        self._topic = topic
        self._counts = counts
        counts[topic] = 0

    def __call__(self, message: object) -> None:
        self._publisher.publish(message)
        self._counts[self._topic] += 1

    @property
    def subscribers(self) -> int:
        """Subscriptions that it reaches."""
        return self._publisher.get_subscription_count()

    def wait_until_received(self, timeout: float) -> None:
        """Wait until every subscription has confirmed what was published, ``timeout`` [s] at most."""
        self._publisher.wait_for_all_acked(Duration(seconds=timeout))


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
        given = given_parameters(self)
        specs = self.parameter_specs(given)
        refuse_unknown(given, specs, self.HAS_ARM)
        if self.HAS_ARM:
            self.arm = declare_arm(self, given)
        self.values: dict[str, Value] = declare_parameters(self, specs, given)
        self.finished = False
        self.diagnostics = Diagnostics(self)

    @classmethod
    def parameter_specs(cls, given: Mapping[str, object]) -> tuple[ParameterSpec, ...]:  # noqa: ARG003
        """The node's own parameters; to be overridden where some depend on what is given."""
        return cls.PARAMETERS

    @classmethod
    def all_parameter_specs(cls) -> tuple[ParameterSpec, ...]:
        """The node's own parameters, whatever is given."""
        return cls.parameter_specs({})

    def listen(
        self, message_type: type, topic: str, handle: Callable[[Any], None], qos: QoSProfile = STREAM
    ) -> Subscription:
        """Subscribe; what ``handle`` raises as a fault of the message is counted and told, and the node goes on."""
        received, faults = self.diagnostics.received, self.diagnostics.faults
        received[topic] = 0

        def on_message(message: object) -> None:
            received[topic] += 1
            try:
                with np.errstate(over="raise"):
                    handle(message)
            except MessageFault as fault:
                faults.note(fault.cause, f"{topic}: {fault.detail}")
            except ContinuumError as error:
                faults.note(messages.REFUSED, f"{topic}: {error}")
            except FloatingPointError:
                faults.note(messages.REFUSED, f"{topic}: numbers too large to compute with")

        return self.create_subscription(message_type, topic, on_message, qos)

    def offer(self, message_type: type, topic: str, qos: QoSProfile = STREAM) -> CountedPublisher:
        """Advertise a topic."""
        return CountedPublisher(self.create_publisher(message_type, topic, qos), topic, self.diagnostics.published)

    def draining(self) -> bool:
        """Asked after a request to stop: whether the node still has to be served before it is closed."""
        return False

    def close(self) -> None:
        """Called once before the process ends, also after a signal."""

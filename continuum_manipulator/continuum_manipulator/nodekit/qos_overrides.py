"""The parameters ``qos_overrides.<topic>.<publisher or subscription>.<policy>`` of a node's topics."""

from __future__ import annotations

from collections.abc import Iterable

from rclpy.node import Node

from continuum.parameter_spec import ParameterSpec
from continuum_manipulator.nodekit.parameters import OF_EVERY_NODE_PREFIX, UnknownParameterError

POLICIES = (
    ParameterSpec(
        "history", str, "which messages are kept", default="keep_last",
        choices=("keep_last", "keep_all", "system_default"),
    ),
    ParameterSpec("depth", int, "number of messages that are kept", lower=1, upper=2**31 - 1, default=1),
    ParameterSpec(
        "reliability", str, "whether lost messages are sent again", default="reliable",
        choices=("reliable", "best_effort", "system_default"),
    ),
)  # fmt: skip

OF_EVERY_NODE = tuple(f"{OF_EVERY_NODE_PREFIX}{topic}." for topic in ("/clock", "/parameter_events"))
"""Parameters that rclpy declares."""


def check_overrides(node: Node, topic: str, end: str) -> set[str]:
    """Check the given parameters of one ``end`` (publisher or subscription) of a topic, and return all names.

    Raises:
        InvalidValueError: a value is not allowed.
    """
    prefix = f"{OF_EVERY_NODE_PREFIX}{topic}.{end}."
    for spec in POLICIES:
        if node.has_parameter(prefix + spec.name):
            spec.check(node.get_parameter(prefix + spec.name).value, prefix)
    return {prefix + spec.name for spec in POLICIES}


def refuse_unknown_overrides(node: Node, known: Iterable[str]) -> None:
    """Check that the node's parameters ``qos_overrides`` are among the ``known`` ones.

    Raises:
        UnknownParameterError: a parameter is unknown.
    """
    allowed = sorted(known)
    for name in node.list_parameters([], 0).names:
        if name.startswith(OF_EVERY_NODE_PREFIX) and not name.startswith(OF_EVERY_NODE) and name not in allowed:
            raise UnknownParameterError(name, allowed)

"""Choice of a ROS domain in which no other node publishes on the demo's topics."""

from __future__ import annotations

import os
import socket
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import rclpy
from domain_coordinator import domain_id
from rclpy.context import Context
from rclpy.topic_endpoint_info import TopicEndpointInfo

from continuum.recordings.arm_recording import OPTIONAL_SECTION_TOPICS, OPTIONAL_TOPICS, SECTION_TOPICS, TOPICS
from tools.demo.errors import DemoError

DISCOVERY_TIME = 1.5
"""Time within which running nodes are discovered [s]."""

LARGEST = 232
"""Largest domain number."""

STREAMS = (*TOPICS, *SECTION_TOPICS, *OPTIONAL_TOPICS, *OPTIONAL_SECTION_TOPICS)

_NAMELESS = "a node"
"""Text for a node whose publishers are discovered but whose name is not."""


@contextmanager
def domain_for_demo() -> Iterator[int]:
    """Reserve the domain of ROS_DOMAIN_ID, or otherwise 0 or the first free one.

    Raises:
        DemoError: ROS_DOMAIN_ID is not a domain, or the domain is in use.
    """
    wanted = os.environ.get("ROS_DOMAIN_ID") or "0"
    if not (wanted.isdecimal() and int(wanted) <= LARGEST):
        raise DemoError(f"ROS_DOMAIN_ID is {wanted!r}; allowed: a whole number from 0 to {LARGEST}")
    with ExitStack() as held:
        domain = int(wanted)
        occupants = occupied_by(domain, held)
        if occupants and os.environ.get("ROS_DOMAIN_ID"):
            raise DemoError(
                f"ROS domain {domain} is in use by {', '.join(occupants)}; end them, or set ROS_DOMAIN_ID to another"
            )
        if occupants:
            busy = f"ROS domain {domain} is in use by {', '.join(occupants)}"
            while occupants:
                domain = held.enter_context(domain_id())  # skips domains that are held already
                occupants = occupied_by(domain, held)
            print(f"{busy}; the demo runs in domain {domain}. To look at it: export ROS_DOMAIN_ID={domain}")
        yield domain


def occupied_by(domain: int, held: ExitStack) -> list[str]:
    """Return the users of the domain, another demo or nodes on the demo's topics; if there are none, reserve it."""
    reservation = held.enter_context(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM))
    try:
        reservation.bind(f"\0continuum-demo-in-ros-domain-{domain}")
    except OSError:
        return ["another demo"]
    return speakers(domain)


def speakers(domain: int) -> list[str]:
    """Return the names of nodes that publish on the demo's topics, as far as they are discovered in time."""
    context = Context()
    rclpy.init(context=context, domain_id=domain)
    try:
        node = rclpy.create_node("demo_look", context=context)
        deadline = time.monotonic() + DISCOVERY_TIME
        found: set[str] = set()
        while time.monotonic() < deadline and (not found or _NAMELESS in found):
            time.sleep(0.05)
            ends = [end for topic in STREAMS for end in node.get_publishers_info_by_topic(topic)]
            found = {_NAMELESS if "UNKNOWN" in end.node_name else _full_name(end) for end in ends}
        node.destroy_node()
    finally:
        rclpy.try_shutdown(context=context)
    return sorted(found)


def _full_name(end: TopicEndpointInfo) -> str:
    return f"{end.node_namespace.rstrip('/')}/{end.node_name}"

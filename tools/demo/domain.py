"""A ROS domain in which nobody else speaks on the demo's topics: neither disturbs the other."""

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
"""Within this time nodes that run are discovered [s]."""

LARGEST = 232
"""Largest number of a domain."""

STREAMS = (*TOPICS, *SECTION_TOPICS, *OPTIONAL_TOPICS, *OPTIONAL_SECTION_TOPICS)

_NAMELESS = "a node"
"""Whose name has not been discovered yet, as its publishers have."""


@contextmanager
def domain_for_demo() -> Iterator[int]:
    """The domain that ROS_DOMAIN_ID says, or else 0, or else the first that is free.

    Raises:
        DemoError: ROS_DOMAIN_ID is no domain, or others speak there already.
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
                domain = held.enter_context(domain_id())  # those that are held already are passed over
                occupants = occupied_by(domain, held)
            print(f"{busy}; the demo runs in domain {domain}. To look at it: export ROS_DOMAIN_ID={domain}")
        yield domain


def occupied_by(domain: int, held: ExitStack) -> list[str]:
    """Who uses the domain: another demo, or nodes that publish on the demo's topics; if nobody, reserve it."""
    reservation = held.enter_context(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM))
    try:
        reservation.bind(f"\0continuum-demo-in-ros-domain-{domain}")
    except OSError:
        return ["another demo"]
    return speakers(domain)


def speakers(domain: int) -> list[str]:
    """Names of nodes that publish on the demo's topics, if one is found while looking."""
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

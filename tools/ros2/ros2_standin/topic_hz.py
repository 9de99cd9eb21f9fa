"""``ros2 topic hz``: rate of arrival of a topic's messages."""

from __future__ import annotations

import argparse
import math
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ros2_standin.interface_types import message_class
from ros2_standin.qos import add_qos_arguments, qos_for_subscribing
from ros2_standin.session import Session, add_discovery_arguments, open_session, positive_int
from ros2_standin.topic_graph import the_topic_type, wait_for_topic


class ArrivalRate:
    """Statistics of the times between messages.

    Args:
        window: number of the newest intervals that count.
    """

    def __init__(self, window: int) -> None:
        self._intervals: deque[float] = deque(maxlen=window)
        self._last: float | None = None

    def arrive(self, instant: float) -> None:
        """Record the arrival of a message at ``instant`` [s]."""
        if self._last is not None:
            self._intervals.append(instant - self._last)
        self._last = instant

    def text(self) -> str | None:
        """The stock tool's two lines, None before the second message."""
        count = len(self._intervals)
        if not count:
            return None
        mean = math.fsum(self._intervals) / count
        deviation = math.sqrt(math.fsum((interval - mean) ** 2 for interval in self._intervals) / count)
        rate = 1.0 / mean if mean > 0 else math.inf
        return (
            f"average rate: {rate:.3f}\n\tmin: {min(self._intervals):.3f}s max: {max(self._intervals):.3f}s "
            f"std dev: {deviation:.5f}s window: {count + 1}"
        )


@contextmanager
def raw_messages(session: Session, args: argparse.Namespace, arrive: Callable[[bytes], None]) -> Iterator[None]:
    """Pass serialised messages of the topic to ``arrive``; wait for a topic that does not exist yet."""
    wait_for_topic(session, args.topic_name)
    message_type = message_class(the_topic_type(session, args.topic_name))
    qos = qos_for_subscribing(args, session.node, session.node.resolve_topic_name(args.topic_name))
    subscription = session.node.create_subscription(message_type, args.topic_name, arrive, qos, raw=True)
    try:
        yield
    finally:
        session.node.destroy_subscription(subscription)


def hz_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``hz``."""
    add_discovery_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    parser.add_argument(
        "-w",
        "--window",
        type=positive_int,
        default=10000,
        help="window size, in # of messages, for calculating rate (default: 10000)",
    )
    parser.add_argument("--wall-time", action="store_true", help="Changes nothing here: rates are always of wall time")
    add_qos_arguments(parser, "subscribe", "sensor_data")


def hz_verb(args: argparse.Namespace) -> None:
    """Print the rate once a second until interrupted; waits for a topic that is not there yet."""
    with open_session(args) as session:
        rate = ArrivalRate(args.window)
        fresh = False

        def arrive(_raw: bytes) -> None:
            nonlocal fresh
            fresh = True
            rate.arrive(time.monotonic())

        with raw_messages(session, args, arrive):
            while True:
                fresh = False
                session.spin_for(1.0)
                if fresh and (text := rate.text()):
                    print(text, flush=True)

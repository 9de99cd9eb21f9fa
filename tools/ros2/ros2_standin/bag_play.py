"""``ros2 bag play``: publish the recorded bytes with the recorded quality of service and intervals."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterable, Iterator
from pathlib import Path

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSDurabilityPolicy, QoSHistoryPolicy, QoSProfile, QoSReliabilityPolicy
from rosbags.interfaces import Connection, Qos
from rosbags.rosbag2 import Reader
from rosgraph_msgs.msg import Clock

from ros2_standin.bag_file import open_bag
from ros2_standin.errors import UserError
from ros2_standin.interface_types import message_class
from ros2_standin.session import Session, nonnegative_float, open_session, positive_float

_ACKNOWLEDGED = Duration(seconds=2)
"""Longest wait at the end for reliable readers to receive the last messages [s]."""

_DEFAULT_DEPTH = 100
_UNLIMITED_DEPTH = 1000
"""Depth for a recorded history without limit or without a known depth."""


def play_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``play``."""
    parser.add_argument("bag_path", type=Path, help="Bag to open")
    parser.add_argument(
        "-r", "--rate", type=positive_float, default=1.0, help="rate at which to play back messages (default: 1)"
    )
    parser.add_argument("--topics", nargs="+", metavar="topic", help="topics to replay (default: all)")
    parser.add_argument("--exclude-topics", nargs="+", metavar="topic", default=[], help="topics not to replay")
    parser.add_argument(
        "-m", "--remap", nargs="+", default=[], metavar="old:=new", help="list of topics to be remapped"
    )
    parser.add_argument("-l", "--loop", action="store_true", help="start again at the end, until interrupted")
    parser.add_argument(
        "--clock",
        nargs="?",
        type=positive_float,
        const=40.0,
        metavar="HZ",
        help="publish to /clock at this frequency of wall time (default 40)",
    )
    parser.add_argument(
        "-d", "--delay", type=nonnegative_float, default=0.0, help="Sleep S seconds before the first message"
    )
    parser.add_argument(
        "--start-offset", type=nonnegative_float, default=0.0, help="Start that many seconds into the bag"
    )
    parser.add_argument("--playback-duration", type=positive_float, help="Play that many seconds of the bag")
    parser.add_argument("--disable-keyboard-controls", action="store_true", help="Changes nothing here: there are none")


def play_verb(args: argparse.Namespace) -> None:
    """Play once or repeatedly."""
    for rule in args.remap:
        args.ros_args += ["--ros-args", "-r", rule]
    with open_bag(args.bag_path) as reader, open_session(args, "rosbag2_player") as session:
        wanted = _wanted(args, reader)
        publishers = {connection.id: _publisher(session.node, connection) for connection in wanted}
        clock = session.node.create_publisher(Clock, "/clock", 10) if args.clock else None
        first = reader.start_time + round(args.start_offset * 1e9)
        last = first + round(args.playback_duration * 1e9) if args.playback_duration else reader.end_time
        _report(playing_text(args.bag_path, wanted, last - first))
        session.spin_for(args.delay)
        count = 0
        while reader.message_count:
            messages = (
                (stamp, publishers[connection.id], data)
                for connection, stamp, data in reader.messages(wanted, start=first, stop=last)
            )
            if clock:
                messages = with_clock(messages, clock, first, last, args.rate / args.clock)
            count += _play(session, messages, first, args.rate)
            if not args.loop:
                break
        for publisher in publishers.values():
            publisher.wait_for_all_acked(_ACKNOWLEDGED)
        _report(f"ended, {count} messages played")


def _report(text: str) -> None:
    print(f"[INFO] [rosbag2_player]: {text}", file=sys.stderr, flush=True)


def playing_text(path: Path, connections: Iterable[Connection], duration: int) -> str:
    """Return a description of the played topics; ``duration`` [ns] of the bag."""
    topics = sorted((connection.topic, connection.msgcount) for connection in connections)
    lines = [f"playing '{path}': {max(duration, 0) / 1e9:.1f} s, {len(topics)} topics; recorded messages of each:"]
    return "\n".join([*lines, *(f"{count:>8}  {topic}" for topic, count in topics)])


def _play(session: Session, messages: Iterable[tuple[int, Publisher, object]], first: int, rate: float) -> int:
    """Publish each message when its time has come; times of the bag in ns, ``rate`` of bag over wall time.

    Returns:
        Number of messages of the bag, without those of ``/clock``.
    """
    begin = time.monotonic()
    count = 0
    for stamp, publisher, data in messages:
        wait = begin + (stamp - first) * 1e-9 / rate - time.monotonic()
        if wait > 0:
            time.sleep(wait)
        publisher.publish(data)
        count += isinstance(data, bytes)
    session.spin_for(0.0)
    return count


def with_clock(
    messages: Iterable[tuple[int, Publisher, bytes]], clock: Publisher, first: int, last: int, period: float
) -> Iterator[tuple[int, Publisher, object]]:
    """Yield the messages interleaved with ticks of ``/clock`` from ``first`` to ``last`` [ns], every ``period`` [s]."""
    step = max(1, round(period * 1e9))
    tick = first

    def ticks(until: int) -> Iterator[tuple[int, Publisher, object]]:
        nonlocal tick
        while tick <= until:
            message = Clock()
            message.clock.sec, message.clock.nanosec = divmod(tick, 10**9)
            yield tick, clock, message
            tick += step

    for message in messages:
        yield from ticks(message[0])
        yield message
    yield from ticks(last)


def _wanted(args: argparse.Namespace, reader: Reader) -> list[Connection]:
    known = set(map(_absolute, reader.topics))
    chosen = set(map(_absolute, args.topics)) if args.topics else known
    if unknown := chosen - known:
        raise UserError(f"Not in the bag: {', '.join(sorted(unknown))}; it has: {', '.join(sorted(known))}")
    chosen -= set(map(_absolute, args.exclude_topics))
    found = []
    for connection in reader.connections:
        if _absolute(connection.topic) in chosen:
            try:
                message_class(connection.msgtype)
            except UserError as error:
                print(f"[WARN] [rosbag2_player]: topic '{connection.topic}' is left out: {error}", file=sys.stderr)
                continue
            found.append(connection)
    return found


def _absolute(topic: str) -> str:
    """Return a topic's absolute name; older recorders wrote relative ones."""
    return topic if topic.startswith("/") else f"/{topic}"


def _publisher(node: Node, connection: Connection) -> Publisher:
    qos = recorded_qos(connection.ext.offered_qos_profiles)
    return node.create_publisher(message_class(connection.msgtype), connection.topic, qos)


def recorded_qos(offered: list[Qos]) -> QoSProfile:
    """Return one profile for several recorded publishers: as strict as the strictest, so that all readers match.

    Without a recorded profile it is reliable, volatile, keep last.
    """
    profile = QoSProfile(depth=_DEFAULT_DEPTH)
    if offered:
        depth = max(qos.depth for qos in offered)
        profile.depth = max(depth, _DEFAULT_DEPTH) if depth else _UNLIMITED_DEPTH
        if all(qos.reliability.name == "BEST_EFFORT" for qos in offered):
            profile.reliability = QoSReliabilityPolicy.BEST_EFFORT
        if any(qos.durability.name == "TRANSIENT_LOCAL" for qos in offered):
            profile.durability = QoSDurabilityPolicy.TRANSIENT_LOCAL
        if any(qos.history.name == "KEEP_ALL" for qos in offered):
            profile.history = QoSHistoryPolicy.KEEP_ALL
    return profile

"""``ros2 topic pub``: publish a message that is written as YAML."""

from __future__ import annotations

import argparse
import time

import yaml

from ros2_standin.errors import UserError
from ros2_standin.interface_types import message_class
from ros2_standin.message_fields import fill_message
from ros2_standin.qos import add_qos_arguments, qos_from_arguments
from ros2_standin.session import (
    add_discovery_arguments,
    nonnegative_float,
    nonnegative_int,
    open_session,
    positive_float,
    positive_int,
)


def pub_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``pub``."""
    add_discovery_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to publish to (e.g. '/chatter')")
    parser.add_argument("message_type", help="Type of the ROS message (e.g. 'std_msgs/msg/String')")
    parser.add_argument(
        "values",
        nargs="?",
        default="{}",
        help="Values of the message in YAML (e.g. 'data: Hello World'); a header may be 'auto', a stamp 'now'",
    )
    parser.add_argument(
        "-r", "--rate", metavar="N", type=positive_float, default=1.0, help="Publishing rate in Hz (default: 1)"
    )
    parser.add_argument(
        "-p",
        "--print",
        metavar="N",
        type=nonnegative_int,
        default=1,
        help="Only print every N-th published message (default: 1)",
    )
    count = parser.add_mutually_exclusive_group()
    count.add_argument("-1", "--once", action="store_true", help="Publish one message and exit")
    count.add_argument(
        "-t", "--times", metavar="TIMES", type=positive_int, help="Publish this number of times and then exit"
    )
    parser.add_argument(
        "-w",
        "--wait-matching-subscriptions",
        metavar="N",
        type=nonnegative_int,
        help="Wait until finding this many matching subscriptions (default: 1 with --once or --times, else 0)",
    )
    parser.add_argument(
        "--max-wait-time-secs",
        metavar="S",
        type=nonnegative_float,
        help="Longest time for that wait (default: for ever)",
    )
    parser.add_argument(
        "--keep-alive",
        metavar="S",
        type=nonnegative_float,
        default=0.1,
        help="Keep publishing node alive for S seconds after the last message (default: 0.1)",
    )
    parser.add_argument("-n", "--node-name", help="Name of the created publishing node")
    add_qos_arguments(parser, "publish", "default")


def message_values(text: str) -> dict:
    """YAML of a message as a mapping.

    Raises:
        UserError: not YAML, or not a mapping.
    """
    try:
        values = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise UserError(f"The passed value is not YAML: {' '.join(str(error).split())}") from error
    if not isinstance(values, dict):
        raise UserError("The passed value needs to be a dictionary in YAML format")
    return values


def pub_verb(args: argparse.Namespace) -> None:
    """Publish at the rate, for as often as asked."""
    message = message_class(args.message_type)()
    stampers = fill_message(message, message_values(args.values))
    times = 1 if args.once else args.times
    wanted = args.wait_matching_subscriptions
    if wanted is None:
        wanted = 1 if times else 0
    with open_session(args, args.node_name) as session:
        publisher = session.node.create_publisher(type(message), args.topic_name, qos_from_arguments(args))

        def matched() -> bool:
            return publisher.get_subscription_count() >= wanted

        if not matched():
            print(f"Waiting for at least {wanted} matching subscription(s)...", flush=True)
            if not session.spin_until(matched, args.max_wait_time_secs):
                raise UserError(f"Timed out waiting for {wanted} subscription(s) of {args.topic_name}")
        print("publisher: beginning loop", flush=True)
        next_time = time.monotonic()
        count = 0
        while True:
            for stamp in stampers:
                stamp(session.node.get_clock().now().to_msg())
            publisher.publish(message)
            count += 1
            if args.print and count % args.print == 0:
                print(f"publishing #{count}: {message!r}\n", flush=True)
            if count == times:
                break
            next_time += 1.0 / args.rate
            session.spin_for(next_time - time.monotonic())
        session.spin_for(args.keep_alive)

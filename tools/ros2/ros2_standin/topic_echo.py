"""``ros2 topic echo``: messages as YAML or CSV."""

from __future__ import annotations

import argparse

from ros2_standin.errors import UserError
from ros2_standin.interface_types import message_class
from ros2_standin.message_text import Shortening, csv_text, pick, plain, yaml_text
from ros2_standin.qos import add_qos_arguments, qos_for_subscribing
from ros2_standin.session import add_discovery_arguments, nonnegative_int, open_session, positive_float
from ros2_standin.topic_graph import the_topic_type


def echo_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``echo``."""
    add_discovery_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to listen to (e.g. '/chatter')")
    parser.add_argument("message_type", nargs="?", help="Type of the ROS message (e.g. 'std_msgs/msg/String')")
    add_qos_arguments(parser, "subscribe", "sensor_data")
    parser.add_argument("--csv", action="store_true", help="Output all recursive fields separated by commas")
    parser.add_argument("--field", metavar="FIELD", help="Echo a selected field of a message (e.g. header.stamp)")
    parser.add_argument(
        "-f", "--full-length", action="store_true", help="Output all elements of arrays, bytes and strings"
    )
    parser.add_argument(
        "-l",
        "--truncate-length",
        type=nonnegative_int,
        default=128,
        metavar="N",
        help="The length to truncate arrays, bytes and strings to (default: 128)",
    )
    parser.add_argument("--no-arr", action="store_true", help="Don't print array fields of messages")
    parser.add_argument("--no-str", action="store_true", help="Don't print string fields of messages")
    parser.add_argument("--flow-style", action="store_true", help="Print collections in the block style of one line")
    parser.add_argument("--once", action="store_true", help="Print the first message received and then exit")
    parser.add_argument(
        "--timeout",
        metavar="S",
        type=positive_float,
        help="Exit with code 1 after this many seconds without the message of --once",
    )


def echo_verb(args: argparse.Namespace) -> int:
    """Print what is published until interrupted; a type that is not given is found on the graph."""
    short = Shortening(None if args.full_length else args.truncate_length, args.no_arr, args.no_str)
    path = args.field.split(".") if args.field else []
    received = 0
    problem: UserError | None = None

    def show(message: object) -> None:
        nonlocal received, problem
        if args.once and received:
            return
        received += 1
        try:
            value = plain(pick(message, path), short)
        except UserError as error:
            problem = error
            return
        print(csv_text(value) if args.csv else f"{yaml_text(value, args.flow_style)}---", flush=True)

    def done() -> bool:
        return problem is not None or (args.once and received > 0)

    with open_session(args) as session:
        if args.message_type is None:
            message_type = message_class(the_topic_type(session, args.topic_name))
        else:
            message_type = message_class(args.message_type)
        full = session.node.resolve_topic_name(args.topic_name)
        if args.message_type is not None:
            session.spin_until(lambda: session.node.count_publishers(full) > 0, session.spin_time)
        qos = qos_for_subscribing(args, session.node, full)
        subscription = session.node.create_subscription(message_type, args.topic_name, show, qos)
        ended = session.spin_until(done, args.timeout if args.once else None)
        session.node.destroy_subscription(subscription)
    if problem is not None:
        raise problem
    return 0 if ended else 1

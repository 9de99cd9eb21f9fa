"""``ros2 topic list|info|type|find``: topics in the ROS graph."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from rclpy.node import Node

from ros2_standin.errors import UserError
from ros2_standin.session import Session, add_discovery_arguments, open_session

Endpoints = list  # of rclpy.topic_endpoint_info.TopicEndpointInfo


def is_hidden(name: str) -> bool:
    """Whether a token of the name begins with an underscore."""
    return any(token.startswith("_") for token in name.split("/"))


def topics(node: Node, hidden: bool = False) -> list[tuple[str, list[str]]]:
    """Names and types of all topics that are known now, sorted."""
    return sorted((name, types) for name, types in node.get_topic_names_and_types() if hidden or not is_hidden(name))


def find_topic_types(session: Session, topic: str) -> list[str]:
    """Types of one topic, waiting for discovery; empty if it does not appear."""
    full = session.node.resolve_topic_name(topic)

    def known() -> list[str]:
        return dict(session.node.get_topic_names_and_types()).get(full, [])

    session.spin_until(lambda: bool(known()), session.spin_time)
    return known()


def wait_for_topic(session: Session, topic: str) -> None:
    """Wait without limit until the topic exists; warn if discovery does not find it."""
    if not find_topic_types(session, topic):
        print(f"WARNING: topic [{topic}] does not appear to be published yet", flush=True)
        full = session.node.resolve_topic_name(topic)
        session.spin_until(lambda: full in dict(session.node.get_topic_names_and_types()))


def the_topic_type(session: Session, topic: str) -> str:
    """The one type of a topic, waiting for discovery.

    Raises:
        UserError: the topic does not appear, or it has several types.
    """
    types = find_topic_types(session, topic)
    if not types:
        raise UserError(
            f"WARNING: topic [{topic}] does not appear to be published yet\n"
            "Could not determine the type for the passed topic"
        )
    if len(types) > 1:
        raise UserError(f"Cannot use topic '{topic}', as it contains more than one type: [{', '.join(types)}]")
    return types[0]


def list_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``list``."""
    add_discovery_arguments(parser)
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the topic type")
    parser.add_argument(
        "-c", "--count-topics", action="store_true", help="Only display the number of topics discovered"
    )
    parser.add_argument("-v", "--verbose", action="store_true", help="List full details about each topic")
    parser.add_argument("--include-hidden-topics", action="store_true", help="Consider hidden topics as well")


def list_verb(args: argparse.Namespace) -> None:
    """Print all topics."""
    with open_session(args) as session:
        session.discover()
        known = topics(session.node, args.include_hidden_topics)
        if args.count_topics:
            print(len(known))
        elif args.verbose:
            _list_side("Published topics:", session.node.get_publishers_info_by_topic, known, "publisher")
            _list_side("Subscribed topics:", session.node.get_subscriptions_info_by_topic, known, "subscriber")
        else:
            for name, types in known:
                print(f"{name} [{', '.join(types)}]" if args.show_types else name)


def _list_side(
    title: str, endpoints: Callable[[str], Endpoints], known: list[tuple[str, list[str]]], word: str
) -> None:
    print(title)
    for name, types in known:
        if count := len(endpoints(name)):
            print(f" * {name} [{', '.join(types)}] {count} {word}{'s' if count > 1 else ''}")
    print()


def info_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``info``."""
    add_discovery_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get info (e.g. '/chatter')")
    parser.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="Prints node, type, GID and QoS profile of each publisher and subscription",
    )


def info_verb(args: argparse.Namespace) -> None:
    """Print type and endpoints of one topic."""
    with open_session(args) as session:
        node = session.node
        full = node.resolve_topic_name(args.topic_name)
        session.discover(lambda: full in dict(node.get_topic_names_and_types()))
        types = dict(node.get_topic_names_and_types()).get(full)
        if not types:
            raise UserError(f"Unknown topic '{args.topic_name}'")
        print(f"Type: {types[0] if len(types) == 1 else types}")
        for word, endpoints in (
            ("Publisher", node.get_publishers_info_by_topic(full)),
            ("Subscription", node.get_subscriptions_info_by_topic(full)),
        ):
            print(f"{chr(10) if args.verbose else ''}{word} count: {len(endpoints)}")
            if args.verbose:
                print("".join(f"\n{endpoint}\n" for endpoint in endpoints), end="")


def type_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``type``."""
    add_discovery_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get type (e.g. '/chatter')")


def type_verb(args: argparse.Namespace) -> int:
    """Print a topic's types; exit code 1 if it is not known."""
    with open_session(args) as session:
        types = find_topic_types(session, args.topic_name)
        for name in types:
            print(name)
        return 0 if types else 1


def find_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``find``."""
    add_discovery_arguments(parser)
    parser.add_argument("topic_type", help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')")
    parser.add_argument(
        "-c", "--count-topics", action="store_true", help="Only display the number of topics discovered"
    )
    parser.add_argument("--include-hidden-topics", action="store_true", help="Consider hidden topics as well")


def find_verb(args: argparse.Namespace) -> None:
    """Print the topics of one type."""
    with open_session(args) as session:
        session.discover()
        found = [name for name, types in topics(session.node, args.include_hidden_topics) if args.topic_type in types]
        print(len(found) if args.count_topics else "\n".join(found))

"""``ros2 service list|type|find|call``."""

from __future__ import annotations

import argparse

from rclpy.node import Node

from ros2_standin.interface_types import service_class
from ros2_standin.message_fields import fill_message
from ros2_standin.session import add_discovery_arguments, open_session, positive_float
from ros2_standin.topic_graph import is_hidden
from ros2_standin.topic_pub import message_values


def services(node: Node, hidden: bool = False) -> list[tuple[str, list[str]]]:
    """Names and types of all services that are known now, sorted."""
    return sorted((name, types) for name, types in node.get_service_names_and_types() if hidden or not is_hidden(name))


def list_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``list``."""
    add_discovery_arguments(parser)
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the service type")
    parser.add_argument(
        "-c", "--count-services", action="store_true", help="Only display the number of services discovered"
    )
    parser.add_argument("--include-hidden-services", action="store_true", help="Consider hidden services as well")


def list_verb(args: argparse.Namespace) -> None:
    """Print all services."""
    with open_session(args) as session:
        session.discover()
        known = services(session.node, args.include_hidden_services)
        if args.count_services:
            print(len(known))
            return
        for name, types in known:
            print(f"{name} [{', '.join(types)}]" if args.show_types else name)


def type_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``type``."""
    add_discovery_arguments(parser)
    parser.add_argument("service_name", help="Name of the ROS service to get type (e.g. '/talker/list_parameters')")


def type_verb(args: argparse.Namespace) -> int:
    """Print a service's types; exit code 1 if it is not known."""
    with open_session(args) as session:
        full = session.node.resolve_service_name(args.service_name)

        def known() -> list[str]:
            return dict(session.node.get_service_names_and_types()).get(full, [])

        session.spin_until(lambda: bool(known()), session.spin_time)
        types = known()
        for name in types:
            print(name)
        return 0 if types else 1


def find_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``find``."""
    add_discovery_arguments(parser)
    parser.add_argument("service_type", help="Name of the ROS service type to filter for (e.g. 'std_srvs/srv/Empty')")
    parser.add_argument(
        "-c", "--count-services", action="store_true", help="Only display the number of services discovered"
    )
    parser.add_argument("--include-hidden-services", action="store_true", help="Consider hidden services as well")


def find_verb(args: argparse.Namespace) -> None:
    """Print the services of one type."""
    with open_session(args) as session:
        session.discover()
        known = services(session.node, args.include_hidden_services)
        found = [name for name, types in known if args.service_type in types]
        for line in [len(found)] if args.count_services else found:
            print(line)


def call_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``call``."""
    add_discovery_arguments(parser)
    parser.add_argument("service_name", help="Name of the ROS service to call to (e.g. '/add_two_ints')")
    parser.add_argument("service_type", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    parser.add_argument(
        "values", nargs="?", default="{}", help="Values to fill the service request with in YAML format"
    )
    parser.add_argument(
        "-r", "--rate", metavar="N", type=positive_float, help="Repeat the call at a specific rate in Hz"
    )


def call_verb(args: argparse.Namespace) -> None:
    """Call once, or at a rate until interrupted, and print the response."""
    service = service_class(args.service_type)
    request = service.Request()
    stampers = fill_message(request, message_values(args.values))
    with open_session(args) as session:
        client = session.node.create_client(service, args.service_name)
        if not client.service_is_ready():
            print("waiting for service to become available...", flush=True)
            session.spin_until(client.service_is_ready)
        while True:
            for stamp in stampers:
                stamp(session.node.get_clock().now().to_msg())
            print(f"requester: making request: {request!r}\n", flush=True)
            response = session.result(client.call_async(request), None, args.service_name)
            print(f"response:\n{response!r}\n", flush=True)
            if args.rate is None:
                break
            session.spin_for(1.0 / args.rate)

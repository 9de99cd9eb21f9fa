"""``ros2 node list|info``, and finding a node by its name."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from rclpy.node import Node

from ros2_standin.errors import UserError
from ros2_standin.session import Session, add_discovery_arguments, open_session
from ros2_standin.topic_graph import is_hidden


def node_names(node: Node, hidden: bool = False) -> list[str]:
    """Full names of all nodes that are known now, sorted; twice where two nodes share a name."""
    names = [f"{space.rstrip('/')}/{name}" for name, space in node.get_node_names_and_namespaces()]
    return sorted(name for name in names if hidden or not is_hidden(name))


def find_node(session: Session, name: str) -> str:
    """Full name of a node, waiting for discovery.

    Raises:
        UserError: it does not appear.
    """
    full = name if name.startswith("/") else f"/{name}"
    if not session.spin_until(lambda: full in node_names(session.node, hidden=True), session.spin_time):
        known = ", ".join(node_names(session.node)) or "none"
        raise UserError(f"Node not found: '{full}' (there are: {known})")
    return full


def list_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``list``."""
    add_discovery_arguments(parser)
    parser.add_argument("-a", "--all", action="store_true", help="Display all nodes even hidden ones")
    parser.add_argument("-c", "--count-nodes", action="store_true", help="Only display the number of nodes discovered")


def list_verb(args: argparse.Namespace) -> None:
    """Print all nodes."""
    with open_session(args) as session:
        session.discover()
        names = node_names(session.node, args.all)
        print(len(names) if args.count_nodes else "".join(f"{name}\n" for name in names), end="")


def info_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``info``."""
    add_discovery_arguments(parser)
    parser.add_argument("node_name", help="Fully qualified node name to request information")
    parser.add_argument("--include-hidden", action="store_true", help="Display hidden topics and services as well")


def info_verb(args: argparse.Namespace) -> None:
    """Print a node's topics and services."""
    with open_session(args) as session:
        full = find_node(session, args.node_name)
        session.discover(lambda: full in node_names(session.node, hidden=True))
        space, _, name = full.rpartition("/")
        node = session.node
        sides: dict[str, Callable[[str, str], list[tuple[str, list[str]]]]] = {
            "Subscribers": node.get_subscriber_names_and_types_by_node,
            "Publishers": node.get_publisher_names_and_types_by_node,
            "Service Servers": node.get_service_names_and_types_by_node,
            "Service Clients": node.get_client_names_and_types_by_node,
        }
        print(full)
        for title, query in sides.items():
            print(f"  {title}:")
            for entry, types in sorted(query(name, space or "/")):
                if args.include_hidden or not is_hidden(entry):
                    print(f"    {entry}: {', '.join(types)}")

"""``ros2 lifecycle nodes|get|list|set``: states of managed nodes."""

from __future__ import annotations

import argparse
from typing import Any

from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions, GetState

from ros2_standin.errors import UserError
from ros2_standin.node import find_node, node_names
from ros2_standin.session import Session, add_discovery_arguments, open_session, positive_float

_STATE_TYPE = "lifecycle_msgs/srv/GetState"


def managed_nodes(session: Session) -> list[str]:
    """Full names of the nodes that have states, sorted."""
    services = dict(session.node.get_service_names_and_types())
    return [
        name for name in node_names(session.node, hidden=True) if _STATE_TYPE in services.get(f"{name}/get_state", [])
    ]


class _Remote:
    """The states of one other node.

    Raises:
        UserError: it is not there, has no states, or does not answer.
    """

    def __init__(self, session: Session, name: str, timeout: float) -> None:
        self.name = find_node(session, name)
        self._session = session
        self._timeout = timeout

    def state(self) -> Any:
        return self._call(GetState, "get_state").current_state

    def transitions(self) -> list[Any]:
        """Transitions that the present state allows."""
        return list(self._call(GetAvailableTransitions, "get_available_transitions").available_transitions)

    def change(self, transition: Transition) -> bool:
        return bool(self._call(ChangeState, "change_state", transition=transition).success)

    def _call(self, kind: type, service: str, **fields: object) -> Any:
        client = self._session.node.create_client(kind, f"{self.name}/{service}")
        if not self._session.spin_until(client.service_is_ready, self._session.spin_time):
            raise UserError(f"Node '{self.name}' is no lifecycle node: it offers no service {service}")
        return self._session.result(client.call_async(kind.Request(**fields)), self._timeout, f"node '{self.name}'")


def _add_common(parser: argparse.ArgumentParser) -> None:
    add_discovery_arguments(parser)
    parser.add_argument(
        "--timeout", metavar="S", type=positive_float, default=5.0, help="Longest wait for an answer (default: 5)"
    )


def nodes_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``nodes``."""
    add_discovery_arguments(parser)
    parser.add_argument("-c", "--count-nodes", action="store_true", help="Only display the number of nodes discovered")


def nodes_verb(args: argparse.Namespace) -> None:
    """Print the names of all nodes that have states."""
    with open_session(args) as session:
        session.discover()
        names = managed_nodes(session)
        for line in [len(names)] if args.count_nodes else names:
            print(line)


def get_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``get``."""
    _add_common(parser)
    parser.add_argument("node_name", nargs="?", help="Name of the ROS node; all where none is named")


def get_verb(args: argparse.Namespace) -> None:
    """Print the state of one node, or of every node that has states."""
    with open_session(args) as session:
        if args.node_name:
            names = [args.node_name]
        else:
            session.discover()
            names = managed_nodes(session)
        for name in names:
            state = _Remote(session, name, args.timeout).state()
            print(f"{'' if args.node_name else f'{name}: '}{state.label} [{state.id}]")


def list_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``list``."""
    _add_common(parser)
    parser.add_argument("node_name", help="Name of the ROS node")


def list_verb(args: argparse.Namespace) -> None:
    """Print the transitions that a node's state allows."""
    with open_session(args) as session:
        for entry in _Remote(session, args.node_name, args.timeout).transitions():
            print(f"- {entry.transition.label} [{entry.transition.id}]")
            print(f"\tStart: {entry.start_state.label}\n\tGoal: {entry.goal_state.label}")


def set_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``set``."""
    _add_common(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    parser.add_argument("transition", help="Name or number of the transition (e.g. 'configure', 'activate')")


def set_verb(args: argparse.Namespace) -> int:
    """Ask for a transition; exit code 1 if the node does not make it."""
    with open_session(args) as session:
        remote = _Remote(session, args.node_name, args.timeout)
        offered = [entry.transition for entry in remote.transitions()]
        wanted = [t for t in offered if args.transition in (t.label, str(t.id))]
        if not wanted:
            names = ", ".join(f"{t.label} [{t.id}]" for t in offered) or "none"
            raise UserError(f"Unknown transition requested: '{args.transition}' (the node's state allows: {names})")
        successful = remote.change(wanted[0])
    print("Transitioning successful" if successful else "Transitioning failed")
    return 0 if successful else 1
